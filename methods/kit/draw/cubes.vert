// Corners of cubes, pulled from the instance buffer: SHAPES_AT_ONCE cubes per drawn instance. Bits 1, 2 and 4 of a
// corner are set on the side towards the eye, so that one order of faces, unset bits first, suits every view.
layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z edge τ [red green blue]
};
#ifdef COUNT_ON_GPU
layout(std430, binding = 7) readonly buffer Drawn {
    int count;
};
#else
uniform int count;
#endif
uniform vec3 eye;
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance
#ifndef COLOURED
uniform vec3 colourOfAll;
#endif

flat out vec4 face;  // premultiplied

/// 1 − exp(−x); a series for small x, where the difference from 1 would lose digits.
float opacityOf(float x) {
    if (x > 0.05) return 1.0 - exp(-x);
    return x * (1.0 - x / 2 * (1.0 - x / 3 * (1.0 - x / 4)));
}

void main() {
    int wanted = gl_InstanceID * SHAPES_AT_ONCE + (gl_VertexID >> 3);
    int base = min(wanted, count - 1) * FLOATS;

    // Subtract the eye first, so that coordinates near the eye keep their precision.
    vec3 centre = vec3(values[base], values[base + 1], values[base + 2]) - eye;
    float halfEdge = wanted < count ? 0.5 * values[base + 3] : 0.0;
    vec3 towards = mix(vec3(-halfEdge), vec3(halfEdge), lessThan(centre, vec3(0)));
    bvec3 bits = bvec3(ivec3(gl_VertexID) & ivec3(1, 2, 4));
    vec3 position = mat3(worldToEye) * (centre + mix(-towards, towards, bits));
    // Moves every face slightly nearer, by less than the width of a pixel, so that faces coplanar with the ground do
    // not flicker.
    gl_Position = vec4(position.xy * projection.xy, projection.z * (1.0 + 1.0 / 1024), -position.z);

    float alpha = opacityOf(0.5 * values[base + 4]);
#ifdef COLOURED
    vec3 colour = vec3(values[base + 5], values[base + 6], values[base + 7]);
#else
    vec3 colour = colourOfAll;
#endif
    face = vec4(colour * alpha, alpha);
}
