// The pixels of a billboard in a tile, as a rasteriser finds them: corners are placed in steps of 1/256 pixel, and a
// pixel belongs to a quad if its centre does. Centres on a left or lower edge do, those on a right or upper edge do not.
//
// Quads that reach behind the near plane or far out of the picture are irregular: hardware clips them. Here each pixel
// tests whether its ray meets the quad beyond the near plane.
layout(std430, binding = 0) restrict readonly buffer Instances {
    float values[];  // x y z radius opacity [red green blue]
};
uniform int floats;  // of an instance
uniform vec3 eye;
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance

const float subpixels = 256.0;
const float farOut = 16384.0;  // pixels

Quad quadOfShape(uint shape) {
    uint base = shape * uint(floats);
    vec3 place = vec3(values[base], values[base + 1u], values[base + 2u]) - eye;
    return quadOf(mat3(worldToEye) * place, values[base + 4u] > 0.0 ? values[base + 3u] : 0.0);
}

/// Position in the picture, pixels.
vec2 pixelOf(vec3 place) {
    precise vec2 pixel = (place.xy * projection.xy) * (1.0 / -place.z) * (0.5 * vec2(picture.xy));
    pixel += 0.5 * vec2(picture.xy);
    return pixel;
}

/// Corner `k` of 4, counter-clockwise.
vec3 cornerOf(Quad quad, int k) {
    return cornerOf(quad, vec2(k == 1 || k == 2 ? 1.0 : -1.0, k >= 2 ? 1.0 : -1.0));
}

/// The corners in the picture, 1/256 pixel. Written without arrays, which compilers keep in slow memory.
struct Outline {
    ivec4 x, y;
    bool regular;
};

bool isRegular(vec3 corner, vec2 pixel) {
    return -corner.z >= projection.z && all(lessThan(abs(pixel), vec2(farOut)));
}

Outline outlineOf(Quad quad) {
    vec3 a = cornerOf(quad, 0), b = cornerOf(quad, 1), c = cornerOf(quad, 2), d = cornerOf(quad, 3);
    vec2 atA = pixelOf(a), atB = pixelOf(b), atC = pixelOf(c), atD = pixelOf(d);
    Outline outline;
    outline.regular = isRegular(a, atA) && isRegular(b, atB) && isRegular(c, atC) && isRegular(d, atD);
    vec4 x = vec4(atA.x, atB.x, atC.x, atD.x), y = vec4(atA.y, atB.y, atC.y, atD.y);
    if (!outline.regular) x = y = vec4(0);
    outline.x = ivec4(roundEven(subpixels * (x - 0.5))) + 128;
    outline.y = ivec4(roundEven(subpixels * (y - 0.5))) + 128;
    return outline;
}

int minimum(ivec4 values) {
    return min(min(values.x, values.y), min(values.z, values.w));
}
int maximum(ivec4 values) {
    return max(max(values.x, values.y), max(values.z, values.w));
}

/// First and last pixel, inclusive.
ivec4 pixelsBetween(vec2 low, vec2 high) {
    vec2 size = vec2(picture.xy);
    return ivec4(ceil(clamp(low - 0.5, vec2(0), size)), floor(clamp(high - 0.5, vec2(-1), size - 1.0)));
}

/// Of the part of an irregular quad that is beyond the near plane, with a margin for rounding.
ivec4 pixelsOfClipped(Quad quad) {
    vec2 low = vec2(1e30), high = vec2(-1e30);
    for (int k = 0; k < 4; ++k) {
        vec3 corner = cornerOf(quad, k), next = cornerOf(quad, (k + 1) & 3);
        float beyond = -corner.z - projection.z, nextBeyond = -next.z - projection.z;
        if (beyond >= 0.0) low = min(low, pixelOf(corner)), high = max(high, pixelOf(corner));
        if ((beyond >= 0.0) != (nextBeyond >= 0.0)) {
            vec3 crossing = vec3(mix(corner.xy, next.xy, beyond / (beyond - nextBeyond)), -projection.z);
            low = min(low, pixelOf(crossing)), high = max(high, pixelOf(crossing));
        }
    }
    vec2 margin = 0.1 + 1e-5 * (abs(low) + abs(high));
    return low.x > high.x ? ivec4(0, 0, -1, -1) : pixelsBetween(low - margin, high + margin);
}

/// For tile_pairs.comp.
ivec4 pixelsOf(uint shape) {
    Quad quad = quadOfShape(shape);
    if (!(quad.radius > 0.0)) return ivec4(0, 0, -1, -1);
    Outline outline = outlineOf(quad);
    if (!outline.regular) return pixelsOfClipped(quad);
    vec2 low = vec2(minimum(outline.x), minimum(outline.y)), high = vec2(maximum(outline.x), maximum(outline.y));
    return pixelsBetween(low / subpixels, high / subpixels);
}

/// ⌊(dy·x − dx·y)/256⌋, limited to ±2³⁰; negative also where dy·x − dx·y is 0 on a right or upper edge. The products need
/// more than 32 bits.
int edgeAt(int x, int y, int dx, int dy) {
    bool exclusive = dy > 0 || (dy == 0 && dx <= 0);
    int high, otherHigh, low, otherLow;
    imulExtended(dy, x, high, low);
    imulExtended(dx, y, otherHigh, otherLow);
    uint borrow, borrowMore;
    uint difference = usubBorrow(uint(low), uint(otherLow), borrow);
    difference = usubBorrow(difference, exclusive ? 1u : 0u, borrowMore);
    high -= otherHigh + int(borrow + borrowMore);
    if (high < -64) return -(1 << 30);
    if (high > 63) return 1 << 30;
    return (high << 24) | int(difference >> 8);
}

/// Bits of the pixels of four rows of 8 that lie within all edges.
uint bitsOfRows(ivec4 edges, ivec4 alongX, ivec4 alongY) {
    uint bits = 0u;
    for (int row = 0; row < 4; ++row) {
        ivec4 here = edges + row * alongY;
        for (int column = 0; column < 8; ++column, here += alongX)
            bits |= uint(~(here.x | here.y | here.z | here.w)) >> 31 << (8 * row + column);
    }
    return bits;
}

/// A bit for each pixel of the 8 × 8 from `tilePixel` on, row by row: the lower four rows, then the upper four.
uvec2 coverageOf(Outline outline, ivec2 tilePixel) {
    // Relative to the first pixel's centre. A pixel at column i and row j is inside an edge if E ≥ 0, where
    // E = dx·(256 j − y) − dy·(256 i − x) = 256·(dx·j − dy·i) + dy·x − dx·y; E > 0 for right and upper edges.
    ivec4 x = outline.x - (tilePixel.x << 8) - 128, y = outline.y - (tilePixel.y << 8) - 128;
    if (minimum(x) > 7 << 8 || minimum(y) > 7 << 8 || maximum(x) < 0 || maximum(y) < 0) return uvec2(0);
    ivec4 dx = x.yzwx - x, dy = y.yzwx - y;
    ivec4 edges = ivec4(edgeAt(x.x, y.x, dx.x, dy.x), edgeAt(x.y, y.y, dx.y, dy.y), edgeAt(x.z, y.z, dx.z, dy.z),
                        edgeAt(x.w, y.w, dx.w, dy.w));
    return uvec2(bitsOfRows(edges, -dy, dx), bitsOfRows(edges + 4 * dx, -dy, dx));
}
