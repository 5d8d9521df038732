// First pass with 16-bit moments: after each puff, the moments of all so far are rounded.
// Source: Munstermann2018. Departs: tiles of a compute shader instead of rasteriser-ordered views; b₀ in 32 bits.
layout(std430, binding = 1) writeonly buffer Stored {
    uint stored[];  // pairs of 16-bit moments, MOMENTS/2 per pixel
};
layout(binding = 1, r32f) writeonly uniform image2D total;  // b₀

float whole = 0.0;  // b₀
float q[MOMENTS];

void visitPuff(TilePuff visited, PixelRay ray) {
    PuffOnRay puff = onRay(visited, ray);
    if (!isWithinReach(visited, puff)) return;
#ifdef SURFACE
    Profile profile = surfaceOf(puff, visited.centre, nearMetres, ray.sceneMetres / ray.stretch);
#else
    Profile profile = profileOf(puff);
#endif
    if (profile.depth < 1e-7) return;
    float b[MOMENTS + 1], one[MOMENTS];
    momentsOf(puff, profile, b);
    for (int j = 1; j <= MOMENTS; ++j) b[j] /= b[0];
    quantise(b, one);
    float sum = whole + b[0];
    for (int j = 0; j < MOMENTS; ++j)
        q[j] = floor(clamp((q[j] * whole + one[j] * b[0]) / sum, 0.0, 1.0) * 65535.0 + 0.5) / 65535.0;
    whole = sum;
}

void main() {
    for (int j = 0; j < MOMENTS; ++j) q[j] = 0.0;
    visitPuffsOfTile(rayOfPixel());

    reportLoops();
    ivec2 size = imageSize(total), pixel = pixelOfInvocation();
    if (!all(lessThan(pixel, size))) return;
    int begin = (pixel.y * size.x + pixel.x) * (MOMENTS / 2);
    for (int k = 0; k < MOMENTS / 2; ++k) stored[begin + k] = packUnorm2x16(vec2(q[2 * k], q[2 * k + 1]));
    imageStore(total, pixel, vec4(whole, 0, 0, 0));
}
