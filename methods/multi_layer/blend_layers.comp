// Blends the puffs of a tile in LAYERS layers per pixel.
// SURFACE: a surface at the centre's depth with the alpha of the whole puff along the ray. Otherwise the puff is cut by
// eye and scene and lies at the point on the ray nearest to its centre. Depths are in metres along the camera's axis.
// Source: SalviVaidyanathan2014. Departs: tiles of a compute shader instead of pixel synchronisation.
layout(binding = 0) writeonly uniform image2D picture;

/// Also a fragment: premultiplied colour; transmittance.
struct Layer {
    vec4 looks;
    float depth;
};
Layer layers[LAYERS];

/// Inserts a fragment by its depth. The farthest layer then is one too many and is merged into the one before it, which
/// keeps its depth. Merging an empty layer changes nothing.
void insert(Layer fragment) {
    for (int i = 0; i < LAYERS; ++i) {
        if (fragment.depth < layers[i].depth) {
            Layer pushed = layers[i];
            layers[i] = fragment;
            fragment = pushed;
        }
    }
    vec4 last = layers[LAYERS - 1].looks;
    layers[LAYERS - 1].looks = vec4(last.rgb + last.a * fragment.looks.rgb, last.a * fragment.looks.a);
}

/// A fragment below this would occupy a layer without being visible; also hides rounding of the error function.
const float leastAlpha = 1e-5;

void visitPuff(TilePuff visited, PixelRay ray) {
    PuffOnRay puff = onRay(visited, ray);
    if (!isWithinReach(visited, puff)) return;
#ifdef SURFACE
    float depth = -visited.centre.z;
    bool seen = depth >= nearMetres && depth * ray.stretch <= ray.sceneMetres;
    float alpha = seen ? opacityOf(puff.whole) : 0.0;
#else
    float depth = puff.foot / ray.stretch;  // negative behind the eye
    float alpha = opacityOf(puff.whole * shareOnRay(puff));
#endif
    if (alpha > leastAlpha) insert(Layer(vec4(alpha * visited.looks.rgb, 1.0 - alpha), depth));
}

void main() {
    for (int i = 0; i < LAYERS; ++i) layers[i] = Layer(vec4(0, 0, 0, 1), 1e30);
    visitPuffsOfTile(rayOfPixel());

    vec4 blended = vec4(0, 0, 0, 1);
    for (int i = 0; i < LAYERS; ++i)
        blended = vec4(blended.rgb + blended.a * layers[i].looks.rgb, blended.a * layers[i].looks.a);
    ivec2 pixel = pixelOfInvocation();
    if (all(lessThan(pixel, imageSize(picture)))) imageStore(picture, pixel, vec4(blended.rgb, 1.0 - blended.a));
    reportLoops();
}
