// The four texels of the small picture around a pixel of the full one. Depths are reversed: near / distance, 0 at infinity.
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 1) uniform sampler2D smallDepth;

struct Taps {
    ivec2 place[4];
    float weight[4];  // bilinear, sum 1
    float depth[4];
};

Taps tapsAround(ivec2 pixel) {
    ivec2 size = textureSize(smallDepth, 0);
    vec2 place = (vec2(pixel) + 0.5) * vec2(size) / vec2(textureSize(sceneDepth, 0)) - 0.5;
    vec2 first = floor(place), part = place - first;
    Taps taps;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        taps.place[i] = clamp(ivec2(first) + corner, ivec2(0), size - 1);
        vec2 share = mix(1.0 - part, part, vec2(corner));
        taps.weight[i] = share.x * share.y;
        taps.depth[i] = texelFetch(smallDepth, taps.place[i], 0).r;
    }
    return taps;
}

/// Whether two depths belong to one surface: their distances differ by at most a tenth of the farther one.
bool sameSurface(float a, float b) {
    return abs(a - b) <= 0.1 * max(a, b);
}

/// Whether the pixel and the texels around it lie on several surfaces.
bool atEdge(float depth, Taps taps) {
    for (int i = 0; i < 4; ++i)
        if (!sameSurface(depth, taps.depth[i])) return true;
    return false;
}
