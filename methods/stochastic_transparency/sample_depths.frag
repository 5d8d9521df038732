// First pass: the nearest surface of each sample. The maximum of n/z does not depend on the order of the fragments.
// Source: EndertonEtAl2010, section 3. Departs: samples are in a buffer, updated with atomics, not in a multisampled
// depth buffer.
flat in vec4 centre;
flat in float logDepth;
flat in int puffIndex;
uniform vec4 rays;
uniform float nearMetres;
uniform int pictureWidth;
uniform ivec3 key;  // the seed's halves
layout(binding = 0) uniform sampler2D sceneDepth;
layout(std430, binding = 1) buffer Samples {
    uint nearest[];  // bits of n/z, by pixel and sample; 0: nothing
};

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    Surface surface = surfaceOf(centre, logDepth, rayThrough(gl_FragCoord.xy, rays),
                                texelFetch(sceneDepth, place, 0).r, nearMetres);
    if (surface.depth <= 0.0) discard;
    int pixel = place.y * pictureWidth + place.x;
    uvec2 mask = randomMask(uvec2(key.xy), uvec2(pixel, puffIndex), opacityOf(surface.depth));
    uint bits = floatBitsToUint(surface.nearness);
    for (int s = 0; s < SAMPLES; ++s)
        if ((mask[s / 32] >> (s % 32) & 1u) != 0u) atomicMax(nearest[pixel * SAMPLES + s], bits);
    discard;
}
