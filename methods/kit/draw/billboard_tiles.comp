// Blends the billboards of a tile (tile_shapes.glsl) from the nearest to the farthest:
//
//     C ← C + T·α·c,   A ← A + T·α,   T ← T·(1 − α)
//
// which is the hardware's C ← α·c + (1 − α)·C from the farthest to the nearest. The place of a pixel on a billboard follows
// from linear functions of the pixel,
//
//     W = 1 / distance along the axis,   U/W and V/W: place on the quad, −1 to 1 times `edge`.
//
// A tile ends when no pixel lets more through than a 32-bit alpha can tell from none.
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

void prepareShape(uint slot, uint shape, ivec2 tilePixel) {
    Quad quad = quadOfShape(shape);
    if (!(quad.radius > 0.0)) return;
    Outline outline = outlineOf(cornersOf(quad));
    uvec2 covered = outline.regular ? coverageOf(outline, tilePixel) : uvec2(0xffffffffu);
    cover(slot, covered);
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
        w = vec3(dot(offset, quad.normal.xy), quad.normal.xy * slope) * inverseMetres;
        w.x += 1.0 / -quad.centre.z;
    } else {
        vec3 first = vec3((vec2(tilePixel) - 0.5 * vec2(picture.xy)) * slope, -1);
        w = vec3(dot(first, quad.normal), quad.normal.xy * slope) * inverseMetres;
        u = (vec3(dot(first, quad.right), quad.right.xy * slope) - w * dot(quad.centre, quad.right)) * scale;
        v = (vec3(dot(first, quad.up), quad.up.xy * slope) - w * dot(quad.centre, quad.up)) * scale;
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

/// The pixel's ray.
struct Ray {
    vec2 place;       // pixels from the tile's first corner
    float depth;      // of the scene, reversed
    vec3 direction;   // of length 1
    float sceneMetres;
};
Ray ray;

void setRay(ivec2 pixel) {
    ray.place = vec2(gl_LocalInvocationID.xy) + 0.5;
    ray.depth = texelFetch(sceneDepth, min(pixel, picture.xy - 1), 0).r;
    vec3 along = vec3((2.0 * (vec2(pixel) + 0.5) / vec2(picture.xy) - 1.0) / projection.xy, -1);
    ray.direction = normalize(along);
    ray.sceneMetres = projection.z / max(ray.depth, 1e-9) * length(along);
}

/// α of the billboard in a slot; 0 if it is not drawn there.
float opacityAt(uint slot) {
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

vec4 sum;
float transmittance;

void drawShape(uint slot) {
    float alpha = opacityAt(slot);
    sum += transmittance * alpha * vec4(looks[slot].rgb, 1.0);
    transmittance *= 1.0 - alpha;
}

bool needsMore() {
    return transmittance > leastTransmittance;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool inPicture = all(lessThan(pixel, picture.xy));
    setRay(pixel);
    sum = vec4(0);
    transmittance = inPicture ? 1.0 : 0.0;
    if (drawTile() && inPicture) imageStore(layer, pixel, sum);
}
