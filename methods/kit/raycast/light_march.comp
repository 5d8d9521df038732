// Fraction of the sun's light that reaches each texel: e^(-D), in steps of a texel's edge from the texel's centre to
// the point where the ray to the sun leaves the grid. See light_volume.h.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(binding = 0, r32f) restrict writeonly uniform image3D light;
layout(binding = 1) uniform sampler3D averages;
uniform vec3 end;  // of the grid, in texels
uniform vec3 toSun;
uniform float extinction;  // of a density of 1, per texel

const float darkDepth = 8.0;  // at most 0.03 % of the light remains

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID), texels = imageSize(light);
    if (any(greaterThanEqual(texel, texels))) return;
    // Centres of texels; for texels that extend beyond the grid, clamped to its end.
    vec3 from = min(vec3(texel) + 0.5, end);
    float reach = 1e9;
    for (int axis = 0; axis < 3; ++axis)
        if (toSun[axis] != 0.0) reach = min(reach, ((toSun[axis] > 0.0 ? end[axis] : 0.0) - from[axis]) / toSun[axis]);
    float depth = 0.0;
    for (float begin = 0.0; begin < reach && depth < darkDepth; begin += 1.0) {
        float stretch = min(begin + 1.0, reach) - begin;
        vec3 at = from + (begin + 0.5 * stretch) * toSun;
        depth += stretch * extinction * texture(averages, at / vec3(texels)).r;
    }
    imageStore(light, texel, vec4(exp(-depth)));
}
