/// Haar wavelets of the optical depth A(z) in front of a place z, 0..1 from the nearest to the farthest puff of the ray.
/// A is constant within each of COUNT = 2^(RANK + 1) cells. Source: AizenshteinEtAl2022; Osorio2024.
const int COUNT = 2 << RANK;

#ifdef PIXEL_BOUNDS
layout(std430, binding = 1) BOUNDS_ACCESS buffer Bounds {
    uint bounds[];  // by pixel: bits of 1/(least metres), bits of the most metres; 0: nothing
};
uniform int pictureWidth;

/// Offset and factor of the mapping; the last cell contains the farthest puff alone.
vec2 mappingAt(ivec2 pixel) {
    int first = 2 * (pixel.y * pictureWidth + pixel.x);
    float least = 1.0 / max(uintBitsToFloat(bounds[first]), 1e-30);
    float most = max(uintBitsToFloat(bounds[first + 1]), 1.001 * least);
#ifdef WARP_LOG
    least = log(least), most = log(most);
#endif
    return vec2(least, (1.0 - 1.0 / float(COUNT)) / (most - least));
}
#else
layout(std140, binding = 0) uniform Mapping { vec2 mapping; };
vec2 mappingAt(ivec2 pixel) {
    return mapping;
}
#endif

/// A puff's part of A: a step at a place, or the integral of its Gaussian between eye and scene.
struct Part {
    float depth;       // all of it
    float at;          // z at which the puff is seen
    float centre;      // z of the Gaussian's middle; of a step: `at`
    float width;       // √2·s, in z
    float whole;       // depth without eye and scene
    float begin, end;  // (z − centre)/width at eye and scene
};

/// Limits beyond which the error function is ±1, and a least depth that counts.
const float farOff = 6.0, leastDepth = 1e-5;

/// Where a puff is seen, for its weight. A is needed there alone: the range of distances contains no more.
struct Seen {
    float depth;   // 0: not drawn
    float metres;  // of a surface, along the axis; of a volume, along the ray
};

Seen seenOf(PuffOnRay puff, vec4 centre, float stretch, float sceneMetres, float nearMetres) {
#ifdef VOLUME
    return Seen(puff.whole * shareOnRay(puff), clamp(puff.foot, nearMetres, max(sceneMetres, nearMetres)));
#else
    float metres = -centre.z;
    bool visible = metres > nearMetres && metres * stretch <= sceneMetres;
    return Seen(visible ? puff.whole : 0.0, metres);
#endif
}

/// The mapping is linearised at the place where the puff is seen.
Part partOf(PuffOnRay puff, Seen seen, vec2 mapping) {
#ifdef WARP_LOG
    float at = (log(seen.metres) - mapping.x) * mapping.y, slope = mapping.y / seen.metres;
#else
    float at = (seen.metres - mapping.x) * mapping.y, slope = mapping.y;
#endif
    float width = puff.metres * slope;
    float middle = at - (seen.metres - puff.foot) * slope;
    return Part(seen.depth, clamp(at, 0.0, 1.0), middle, width, puff.whole, clamp(puff.begin, -farOff, farOff),
                clamp(puff.end, -farOff, farOff));
}

/// ∫ erf
float erfIntegral(float x) {
    return x * errorFunction(x) + 0.56418958 * exp(-x * x);
}

/// ∫ A dz of one puff from in front of it to z.
float integralTo(Part part, float z) {
#ifdef VOLUME
    float x = (z - part.centre) / part.width, cut = clamp(x, part.begin, part.end);
    float inside = erfIntegral(cut) - erfIntegral(part.begin) - (cut - part.begin) * errorFunction(part.begin);
    return part.width * (0.5 * part.whole * inside + part.depth * max(x - part.end, 0.0));
#else
    return part.depth * max(z - part.at, 0.0);
#endif
}
