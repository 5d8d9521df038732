// C = sRGB(L + (1 − α)·S)
layout(binding = 0) uniform sampler2D scene;
layout(binding = 1) uniform sampler2D layer;

layout(location = 0) out vec4 colour;

vec3 encodeSrgb(vec3 linear) {
    vec3 value = clamp(linear, 0.0, 1.0);
    vec3 curve = 1.055 * pow(max(value, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * value, lessThanEqual(value, vec3(0.0031308)));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 above = texelFetch(layer, pixel, 0);
    colour = vec4(encodeSrgb(above.rgb + (1.0 - above.a) * texelFetch(scene, pixel, 0).rgb), 1.0);
}
