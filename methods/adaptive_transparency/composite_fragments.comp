// Draws the puffs of a tile in two passes over its fragments. The first inserts each fragment into the visibility of
// its pixel. The second adds the colours:
//
//     C = Σ cᵢ·αᵢ·vis(zᵢ),   α = 1 − Π (1 − αᵢ)
//
// SURFACE: a surface at the centre's depth with the alpha of the whole puff along the ray. Otherwise the puff is cut by
// eye and scene and lies at the point on the ray nearest to its centre. Depths are in metres along the camera's axis.
// `precise`: both passes compute the same depth, so that no fragment hides itself.
// Source: SalviEtAl2011. Departs: tiles of a compute shader; the function stays in the invocation between the passes.
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 0) writeonly uniform image2D picture;
uniform float nearMetres;

struct Fragment {
    float depth;
    float alpha;
    vec3 colour;
};

/// A fragment below this would occupy a node without being visible; also hides rounding of the error function.
const float leastAlpha = 1e-5;

Fragment fragmentOf(int slot, vec3 ray, float stretch, float scene) {
    vec4 centre = centres[slot], looks = looksOf[slot];
    PuffOnRay puff = puffOnRay(centre, looks.w, ray / stretch, scene);
    bool isWithinReach = puff.whole >= exp2(looks.w - 0.72134752 * reach * reach);  // exp(−reach²/2)
#ifdef SURFACE
    precise float depth = -centre.z;
    bool seen = depth >= nearMetres && depth * stretch <= scene;
    float alpha = seen ? opacityOf(puff.whole) : 0.0;
#else
    precise float depth = dot(centre.xyz, ray) / (stretch * stretch);  // negative behind the eye
    float alpha = opacityOf(puff.whole * shareOnRay(puff));
#endif
    return Fragment(depth, isWithinReach ? alpha : 0.0, looks.rgb);
}

void main() {
    ivec2 size = imageSize(picture), pixel = ivec2(gl_GlobalInvocationID.xy);
    int slot = int(gl_LocalInvocationIndex);
    vec3 ray = rayThrough(vec2(pixel) + 0.5, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, min(pixel, size - 1), 0).r, nearMetres, stretch);
    vec4 cone = coneOfTile();
    clearVisibility();
    vec3 colour = vec3(0);

    for (int pass = 0; pass < 2; ++pass)
        for (int first = 0; first < count; first += puffsAtOnce) {
            if (slot < 2) selected[slot] = 0u;
            barrier();
            selectPuff(slot, first + slot, cone);
            barrier();
            for (int word = 0; word < 2; ++word)
                for (uint left = selected[word]; left != 0u; left &= left - 1u) {
                    Fragment fragment = fragmentOf(32 * word + findLSB(left), ray, stretch, scene);
                    if (fragment.alpha <= leastAlpha) continue;
                    if (pass == 0) insert(fragment.depth, 1.0 - fragment.alpha);
                    else colour += visibilityAt(fragment.depth) * fragment.alpha * fragment.colour;
                }
            barrier();
        }
    if (all(lessThan(pixel, size))) imageStore(picture, pixel, vec4(colour, 1.0 - totalTransmittance()));
}
