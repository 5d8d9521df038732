// Combines two halves: C = A left of the divider, B right of it; or C = ½ + gain·(B − A)/2, grey where they are equal.
layout(binding = 0) uniform sampler2D displayA;
layout(binding = 1) uniform sampler2D sceneA;
layout(binding = 2) uniform sampler2D layerA;
layout(binding = 3) uniform sampler2D depthA;
layout(binding = 4) uniform sampler2D displayB;
layout(binding = 5) uniform sampler2D sceneB;
layout(binding = 6) uniform sampler2D layerB;
layout(binding = 7) uniform sampler2D depthB;
uniform vec4 region;       // origin and extent of the visible part, shares of the pictures
uniform vec2 size;         // of the target, pixels
uniform float divider;     // share of the target's width: 1 shows only A, 0 only B
uniform int sideBySide;        // 1: A in the left half of the target, B in the right
uniform float gain;        // of the difference; 0: none is shown
uniform int source;        // 0 display, 1 light, 2 alpha, 3 depth, 4 faults
uniform float exposure;    // factor on light
uniform int encoded;       // 1: light is encoded for display
uniform float nearMetres;  // of the camera
uniform int interpolated;  // 1: bilinear between pixel centres; 0: every pixel is a block of one colour

layout(location = 0) out vec4 colour;

vec3 encodeSrgb(vec3 linear) {
    vec3 value = clamp(linear, 0.0, 1.0);
    vec3 curve = 1.055 * pow(max(value, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * value, lessThanEqual(value, vec3(0.0031308)));
}

vec3 lightOf(vec4 scene, vec4 layer) {
    vec3 light = exposure * (layer.rgb + (1.0 - layer.a) * scene.rgb);
    return encoded > 0 ? encodeSrgb(light) : light;
}

/// White at 1 m, black from 1 km on. Reversed depth is near distance / distance along the axis, and 0 is the sky.
float depthGrey(float depth) {
    return clamp(1.0 - log2(nearMetres / max(depth, 1e-9)) / log2(1000.0), 0.0, 1.0);
}

/// Tests the bits, because a compiler may assume that every number is finite.
bool isFinite(vec4 value) {
    uvec4 exponent = floatBitsToUint(value) & 0x7f800000u;
    return all(notEqual(exponent, uvec4(0x7f800000u)));
}

vec3 faultColour(vec4 layer, vec4 scene, vec3 display) {
    if (!isFinite(layer) || !isFinite(scene)) return vec3(1.0, 0.0, 1.0);
    if (any(lessThan(layer.rgb, vec3(0.0)))) return vec3(0.0, 1.0, 1.0);
    if (layer.a < -1e-3 || layer.a > 1.001) return vec3(1.0, 1.0, 0.0);
    return vec3(0.4 * dot(display, vec3(0.2126, 0.7152, 0.0722)));
}

vec3 texel(sampler2D displayed, sampler2D scene, sampler2D layer, sampler2D depth, ivec2 at) {
    ivec2 pixel = clamp(at, ivec2(0), textureSize(displayed, 0) - 1);
    if (source == 1) return lightOf(texelFetch(scene, pixel, 0), texelFetch(layer, pixel, 0));
    if (source == 2) return texelFetch(layer, pixel, 0).aaa;
    if (source == 3) return vec3(depthGrey(texelFetch(depth, pixel, 0).r));
    vec3 display = texelFetch(displayed, pixel, 0).rgb;
    if (source == 4) return faultColour(texelFetch(layer, pixel, 0), texelFetch(scene, pixel, 0), display);
    return display;
}

/// `place` in pixels from the lower left corner.
vec3 shown(sampler2D displayed, sampler2D scene, sampler2D layer, sampler2D depth, vec2 place) {
    if (interpolated == 0) return texel(displayed, scene, layer, depth, ivec2(floor(place)));
    ivec2 lower = ivec2(floor(place - 0.5));
    vec2 share = fract(place - 0.5);
    vec3 below = mix(texel(displayed, scene, layer, depth, lower),
                     texel(displayed, scene, layer, depth, lower + ivec2(1, 0)), share.x);
    vec3 above = mix(texel(displayed, scene, layer, depth, lower + ivec2(0, 1)),
                     texel(displayed, scene, layer, depth, lower + ivec2(1, 1)), share.x);
    return mix(below, above, share.y);
}

void main() {
    vec2 place = gl_FragCoord.xy / size;
    float beyond = gl_FragCoord.x - divider * size.x;
    bool isA = beyond < 0.0;
    if (sideBySide > 0) {
        isA = place.x < 0.5;
        place.x = fract(2.0 * place.x);
    }
    vec2 at = (region.xy + region.zw * place) * vec2(textureSize(displayA, 0));
    bool needsA = isA || gain > 0.0, needsB = !isA || gain > 0.0;
    vec3 a = needsA ? shown(displayA, sceneA, layerA, depthA, at) : vec3(0.0);
    vec3 b = needsB ? shown(displayB, sceneB, layerB, depthB, at) : vec3(0.0);
    bool onLine = sideBySide == 0 && divider > 0.0 && divider < 1.0 && abs(beyond) <= 1.0;
    colour = vec4(gain > 0.0 ? clamp(0.5 + 0.5 * gain * (b - a), 0.0, 1.0) : onLine ? vec3(1.0) : isA ? a : b, 1.0);
}
