// Draws the puffs of a tile in two passes over its fragments. The first inserts each fragment into the visibility of
// its pixel. The second adds the colours:
//
//     C = Σ cᵢ·αᵢ·vis(zᵢ),   α = 1 − Π (1 − αᵢ)
//
// SURFACE: a surface at the centre's depth with the alpha of the whole puff along the ray. Otherwise the puff is cut by
// eye and scene and lies at the point on the ray nearest to its centre. Depths are in metres along the camera's axis.
// `precise`: both passes compute the same depth, so that no fragment hides itself.
// Source: SalviEtAl2011. Departs: tiles of a compute shader; the function stays in the invocation between the passes.
layout(binding = 0) writeonly uniform image2D picture;
int pass;
vec3 colour = vec3(0);

/// A fragment below this would occupy a node without being visible; also hides rounding of the error function.
const float leastAlpha = 1e-5;

void visitPuff(TilePuff visited, PixelRay ray) {
    PuffOnRay puff = onRay(visited, ray);
    if (!isWithinReach(visited, puff)) return;
#ifdef SURFACE
    precise float depth = -visited.centre.z;
    bool seen = depth >= nearMetres && depth * ray.stretch <= ray.sceneMetres;
    float alpha = seen ? opacityOf(puff.whole) : 0.0;
#else
    precise float depth = dot(visited.centre.xyz, ray.direction) / (ray.stretch * ray.stretch);  // negative behind the eye
    float alpha = opacityOf(puff.whole * shareOnRay(puff));
#endif
    if (alpha <= leastAlpha) return;
    if (pass == 0) insert(depth, 1.0 - alpha);
    else colour += visibilityAt(depth) * alpha * visited.looks.rgb;
}

void main() {
    clearVisibility();
    PixelRay ray = rayOfPixel();
    pass = 0;  // spelt out: the compiler then specialises each pass
    visitPuffsOfTile(ray);
    pass = 1;
    visitPuffsOfTile(ray);
    ivec2 pixel = pixelOfInvocation();
    if (all(lessThan(pixel, imageSize(picture)))) imageStore(picture, pixel, vec4(colour, 1.0 - totalTransmittance()));
    reportLoops();
}
