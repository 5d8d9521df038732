// Blends the billboards of a tile of 8 × 8 pixels, an invocation for each pixel, from the nearest to the farthest:
//
//     C ← C + T·α·c,   A ← A + T·α,   T ← T·(1 − α)
//
// which is the hardware's C ← α·c + (1 − α)·C from the farthest to the nearest. Each invocation also prepares one of 64
// billboards: its pixels, and its place along a ray as linear functions of the pixel,
//
//     W = 1 / distance along the axis,   U/W and V/W: place on the quad, −1 to 1 times `edge`.
//
// A tile ends when no pixel lets more through than a 32-bit alpha can tell from none.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 0) writeonly uniform image2D layer;
uniform vec3 puffColour;  // unless instances have their own

#ifdef PLAIN_ALPHA
const float edge = 1.0;
#else
const float edge = edgeOffset;
#endif
const float leastTransmittance = 5.9604645e-8;  // 2⁻²⁴

shared vec4 across[shapesAtOnce];    // U: constant, per pixel to the right; W: the same
shared vec4 upwards[shapesAtOnce];   // V: constant, per pixel to the right, per pixel up; W: per pixel up
shared vec4 looks[shapesAtOnce];     // colour; log2 of the optical depth; PLAIN_ALPHA: opacity
shared vec2 nearness[shapesAtOnce];  // of billboards.vert; 1: irregular
#ifdef SOFT
shared vec4 centres[shapesAtOnce];  // eye space; 1/(√2·s)
#endif
shared uvec2 pixels[shapesAtOnce];  // that a billboard covers
shared uint drawn[2][2];            // a bit for each billboard that covers some of the lower and the upper four rows
shared uint seen;                   // whether a pixel still lets light through

void prepare(uint slot, uint shape, ivec2 tilePixel) {
    Quad quad = quadOfShape(shape);
    if (!(quad.radius > 0.0)) return;
    Outline outline = outlineOf(quad);
    uvec2 covered = outline.regular ? coverageOf(outline, tilePixel) : uvec2(0xffffffffu);
    pixels[slot] = covered;
    for (int rows = 0; rows < 2; ++rows)
        if (covered[rows] != 0u) atomicOr(drawn[rows][slot >> 5], 1u << (slot & 31u));
    if (covered == uvec2(0)) return;

    // A pixel's ray is (x, y, −1), and meets the quad's plane at the distance 1/W along the axis.
    vec2 slope = 2.0 / (projection.xy * vec2(picture.xy));  // per pixel
    float scale = edge / (1.5 * quad.radius), inverseMetres = 1.0 / dot(quad.centre, quad.normal);
    vec3 u, v, w;
    if (outline.regular) {
        // Relative to the centre's ray, so that rays close to it keep their precision.
        vec2 offset = (vec2(tilePixel) - pixelOf(quad.centre)) * slope;
        u = vec3(dot(offset, quad.right.xy), quad.right.xy * slope) * scale;
        v = vec3(dot(offset, quad.up.xy), quad.up.xy * slope) * scale;
        w = vec3(1.0 / -quad.centre.z + dot(offset, quad.normal.xy) * inverseMetres, quad.normal.xy * slope * inverseMetres);
    } else {
        vec3 ray = vec3((vec2(tilePixel) - 0.5 * vec2(picture.xy)) * slope, -1);
        w = vec3(dot(ray, quad.normal), quad.normal.xy * slope) * inverseMetres;
        u = (vec3(dot(ray, quad.right), quad.right.xy * slope) - w * dot(quad.centre, quad.right)) * scale;
        v = (vec3(dot(ray, quad.up), quad.up.xy * slope) - w * dot(quad.centre, quad.up)) * scale;
    }
    across[slot] = vec4(u.xy, w.xy);
    upwards[slot] = vec4(v, w.z);
    uint base = shape * uint(floats);
    float opacity = values[base + 4u];
#ifndef PLAIN_ALPHA
    opacity = log2(max(opticalDepth(opacity), 1e-30));
#endif
    vec3 colour = floats == 8 ? vec3(values[base + 5u], values[base + 6u], values[base + 7u]) : puffColour;
    looks[slot] = vec4(colour, opacity);
    nearness[slot] = vec2(quad.nearness, outline.regular ? 0.0 : 1.0);
#ifdef SOFT
    centres[slot] = vec4(quad.centre, sqrt(2.0) / max(quad.radius, 1e-20));
#endif
}

/// The pixel's ray and what it meets.
struct Ray {
    vec2 place;  // pixels from the tile's first corner
    float depth;  // of the scene, reversed
    vec3 direction;  // of length 1
    float sceneMetres;
};

Ray rayOf(ivec2 pixel) {
    Ray ray;
    ray.place = vec2(gl_LocalInvocationID.xy) + 0.5;
    ray.depth = texelFetch(sceneDepth, min(pixel, picture.xy - 1), 0).r;
    vec3 along = vec3((2.0 * (vec2(pixel) + 0.5) / vec2(picture.xy) - 1.0) / projection.xy, -1);
    ray.direction = normalize(along);
    ray.sceneMetres = projection.z / max(ray.depth, 1e-9) * length(along);
    return ray;
}

/// α of the billboard in a slot; 0 if it is not drawn there.
float opacityAt(uint slot, Ray ray) {
    vec4 a = across[slot], b = upwards[slot];
    float u = a.x + a.y * ray.place.x, v = b.x + b.y * ray.place.x + b.z * ray.place.y;
    float w = a.z + a.w * ray.place.x + b.w * ray.place.y;
    vec2 kind = nearness[slot];
    if (kind.y > 0.0 && !(w > 0.0 && projection.z * w <= 1.0 && max(abs(u), abs(v)) <= edge * w)) return 0.0;
#ifndef SOFT
    if (projection.z * w < ray.depth) return 0.0;
#endif
    float offset = u * u + v * v, power = looks[slot].w;
#ifdef PLAIN_ALPHA
    float away = min(sqrt(offset) / w, 1.0);
    float depth = power * (1.0 - away * away * (3.0 - 2.0 * away));
#else
    float depth = exp2(power - offset / (w * w + offset * kind.x));
#endif
#ifdef SOFT
    vec4 centre = centres[slot];
    float foot = dot(centre.xyz, ray.direction);
    depth *= 0.5 * (errorFunction((ray.sceneMetres - foot) * centre.w) + errorFunction(foot * centre.w));
#endif
#ifdef PLAIN_ALPHA
    return depth;
#else
    return 1.0 - exp2(-depth);
#endif
}

void main() {
    uint own = gl_LocalInvocationIndex, rows = own >> 5, bit = 1u << (own & 31u);
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), tilePixel = 8 * ivec2(gl_WorkGroupID.xy);
    openLists(ivec2(gl_WorkGroupID.xy), own);
    if (listCount == 0u) return;

    bool inPicture = all(lessThan(pixel, picture.xy));
    Ray ray = rayOf(pixel);
    vec4 sum = vec4(0);
    float transmittance = inPicture ? 1.0 : 0.0;
    bool more = true;
    // llvmpipe ends a loop after 65,535 iterations.
    while (more)
        for (int batch = 0; batch < 32768 && more; ++batch) {
            if (own < 4u) drawn[own >> 1][own & 1u] = 0u;
            if (own == 0u) seen = 0u;
            uint shape, found = nextShapes(own, shape);
            if (own < found) prepare(own, shape, tilePixel);
            if (transmittance > leastTransmittance) seen = 1u;
            barrier();
            more = found > 0u && seen > 0u;
            if (more)
                for (uint word = 0u; word < 2u; ++word)
                    for (uint left = drawn[rows][word]; left != 0u; left &= left - 1u) {
                        uint slot = 32u * word + uint(findLSB(left));
                        if ((pixels[slot][rows] & bit) == 0u) continue;
                        float alpha = opacityAt(slot, ray);
                        sum += transmittance * alpha * vec4(looks[slot].rgb, 1.0);
                        transmittance *= 1.0 - alpha;
                    }
            barrier();
        }
    if (inPicture) imageStore(layer, pixel, sum);
}
