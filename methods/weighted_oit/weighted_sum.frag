// Σ α·w·c and Σ α·w of the puffs in front of the scene; and Π(1 − α) if PRODUCT, otherwise the sum of their depths.
flat in vec4 centre;
flat in float logDepth;
#ifdef COLOURED
flat in vec3 puffColour;
#else
uniform vec3 puffColour;
#endif
uniform vec4 rays;
layout(binding = 0) uniform sampler2D sceneDepth;

layout(location = 0) out vec4 weighted;
layout(location = 1) out float revealage;  // blended: PRODUCT multiplies by 1 − this

void main() {
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, nearMetres, stretch);
    WeightedPuff puff = weightedPuff(centre, logDepth, ray, stretch, scene);
    weighted = vec4(puff.share * puffColour, puff.share);
#if PRODUCT == 1
    revealage = puff.alpha;
#else
    revealage = puff.depth;
#endif
}
