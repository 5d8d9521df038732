// Second pass: Σ v·α·c and Σ v·α of the puffs, v the share of samples in which nothing is nearer; and Σ τ.
// Source: EndertonEtAl2010, section 3 (depth-based). Departs: Π(1 − α) is exp(−Σ τ).
flat in vec4 centre;
flat in float logDepth;
#ifdef COLOURED
flat in vec3 puffColour;
#else
uniform vec3 puffColour;
#endif
uniform vec4 rays;
uniform float nearMetres;
uniform int pictureWidth;
layout(binding = 0) uniform sampler2D sceneDepth;
layout(std430, binding = 1) readonly buffer Samples {
    uint nearest[];
};

layout(location = 0) out vec4 seen;
#if CORRECTED == 1
layout(location = 1) out float depthSum;
#endif

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    Surface surface = surfaceOf(centre, logDepth, rayThrough(gl_FragCoord.xy, rays),
                                texelFetch(sceneDepth, place, 0).r, nearMetres);
    uint bits = floatBitsToUint(surface.nearness);
    int first = (place.y * pictureWidth + place.x) * SAMPLES, visible = 0;
    for (int s = 0; s < SAMPLES; ++s) visible += int(bits >= nearest[first + s]);
    float share = float(visible) / float(SAMPLES) * opacityOf(surface.depth);
    seen = vec4(share * puffColour, share);
#if CORRECTED == 1
    depthSum = surface.depth;
#endif
}
