// The pixels of a quad in a tile, as a rasteriser finds them: corners are placed in steps of 1/256 pixel, and a pixel
// belongs to a quad if its centre does. Centres on a left or lower edge do, those on a right or upper edge do not.
//
// Quads that reach behind the near plane or far out of the picture are irregular: hardware clips them. Users of this
// must test for each pixel whether its ray meets the quad beyond the near plane.
uniform vec3 projection;  // x and y scale, near distance

const float subpixels = 256.0;
const float farOut = 16384.0;  // pixels

/// Eye space, counter-clockwise.
struct Corners {
    vec3 a, b, c, d;
};

/// In the picture, 1/256 pixel. Written without arrays, which compilers keep in slow memory.
struct Outline {
    ivec4 x, y;
    bool regular;
};

/// Position in the picture, pixels.
vec2 pixelOf(vec3 place) {
    precise vec2 pixel = (place.xy * projection.xy) * (1.0 / -place.z) * (0.5 * vec2(picture.xy));
    pixel += 0.5 * vec2(picture.xy);
    return pixel;
}

bool isRegular(vec3 corner, vec2 pixel) {
    return -corner.z >= projection.z && all(lessThan(abs(pixel), vec2(farOut)));
}

Outline outlineOf(Corners corners) {
    vec2 a = pixelOf(corners.a), b = pixelOf(corners.b), c = pixelOf(corners.c), d = pixelOf(corners.d);
    Outline outline;
    outline.regular = isRegular(corners.a, a) && isRegular(corners.b, b) && isRegular(corners.c, c) &&
                      isRegular(corners.d, d);
    vec4 x = vec4(a.x, b.x, c.x, d.x), y = vec4(a.y, b.y, c.y, d.y);
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

/// First and last pixel, inclusive; the last before the first if there are none (tile_pairs.comp).
ivec4 pixelsBetween(vec2 low, vec2 high) {
    vec2 size = vec2(picture.xy);
    return ivec4(ceil(clamp(low - 0.5, vec2(0), size)), floor(clamp(high - 0.5, vec2(-1), size - 1.0)));
}
const ivec4 noPixels = ivec4(0, 0, -1, -1);

/// Extends the box by the part of an edge that is beyond the near plane.
void extend(vec3 from, vec3 to, inout vec2 low, inout vec2 high) {
    float beyond = -from.z - projection.z, beyondOfEnd = -to.z - projection.z;
    if (beyond >= 0.0) low = min(low, pixelOf(from)), high = max(high, pixelOf(from));
    if ((beyond >= 0.0) == (beyondOfEnd >= 0.0)) return;
    vec2 crossing = pixelOf(vec3(mix(from.xy, to.xy, beyond / (beyond - beyondOfEnd)), -projection.z));
    low = min(low, crossing), high = max(high, crossing);
}

ivec4 pixelsOfQuad(Corners corners) {
    Outline outline = outlineOf(corners);
    if (outline.regular)
        return pixelsBetween(vec2(minimum(outline.x), minimum(outline.y)) / subpixels,
                             vec2(maximum(outline.x), maximum(outline.y)) / subpixels);
    vec2 low = vec2(1e30), high = vec2(-1e30);
    extend(corners.a, corners.b, low, high);
    extend(corners.b, corners.c, low, high);
    extend(corners.c, corners.d, low, high);
    extend(corners.d, corners.a, low, high);
    vec2 margin = 0.1 + 1e-5 * (abs(low) + abs(high));  // for rounding
    return low.x > high.x ? noPixels : pixelsBetween(low - margin, high + margin);
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
