// Two pictures in one: C = A left of the divider, B right of it; or C = ½ + gain·(B − A)/2, grey where they agree.
layout(binding = 0) uniform sampler2D pictureA;
layout(binding = 1) uniform sampler2D pictureB;
uniform vec4 region;    // origin and extent, shares of the pictures
uniform vec2 size;      // of the target, pixels
uniform float divider;  // share of the target's width: 1 is A alone, 0 is B alone
uniform float gain;     // of the difference; 0: none is shown

layout(location = 0) out vec4 colour;

void main() {
    vec2 place = gl_FragCoord.xy / size;
    vec2 texel = (region.xy + region.zw * place) * vec2(textureSize(pictureA, 0));
    ivec2 pixel = clamp(ivec2(floor(texel)), ivec2(0), textureSize(pictureA, 0) - 1);
    vec3 a = texelFetch(pictureA, pixel, 0).rgb;
    vec3 b = texelFetch(pictureB, pixel, 0).rgb;
    if (gain > 0.0) {
        colour = vec4(clamp(0.5 + 0.5 * gain * (b - a), 0.0, 1.0), 1.0);
        return;
    }
    float beyond = gl_FragCoord.x - divider * size.x;
    bool onLine = divider > 0.0 && divider < 1.0 && abs(beyond) <= 1.0;
    colour = vec4(onLine ? vec3(1.0) : beyond < 0.0 ? a : b, 1.0);
}
