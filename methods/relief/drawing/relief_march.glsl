// Finds the first hit of a ray with the relief. Coordinates: u, v in texels, texel (i, j) at (i, j); depth 0 at the
// face, 1 at the bottom. surface/surface_hit.h is the reference.
layout(std430, binding = 1) readonly buffer Depths { float depths[]; };
layout(std430, binding = 2) readonly buffer Blocks { float blocks[]; };
layout(std430, binding = 3) readonly buffer Levels { ivec4 levels[]; };  // offset, columns, rows
uniform int lastLevel;
uniform vec2 texels;  // columns, rows

const float missed = 2.0;

float depthOf(ivec2 texel) {
    ivec2 size = ivec2(texels);
    ivec2 inside = clamp(texel, ivec2(0), size - 1);
    return depths[inside.y * size.x + inside.x];
}

float depthAt(vec2 place) {
    ivec2 corner = ivec2(floor(place));
    vec2 share = place - floor(place);
    return mix(mix(depthOf(corner), depthOf(corner + ivec2(1, 0)), share.x),
               mix(depthOf(corner + ivec2(0, 1)), depthOf(corner + ivec2(1, 1)), share.x), share.y);
}

#ifdef PAPER_MARCH
// 15 linear and 5 binary steps. Source: Policarpo2005. Misses features thinner than a linear step.
float firstHit(vec3 from, vec3 to) {
    float before = 0.0, after = missed;
    for (int k = 0; k <= LINEAR_STEPS; ++k) {
        float t = float(k) / float(LINEAR_STEPS);
        vec3 place = mix(from, to, t);
        if (place.z >= depthAt(place.xy)) {
            after = t;
            break;
        }
        before = t;
    }
    if (after == missed || after == 0.0) return after;
    for (int k = 0; k < BINARY_STEPS; ++k) {
        float t = 0.5 * (before + after);
        vec3 place = mix(from, to, t);
        if (place.z >= depthAt(place.xy)) after = t;
        else before = t;
    }
    return after;
}
#else
// The first t in [begin, end] with a·t² + b·t + c >= 0.
float firstNotNegative(float a, float b, float c, float begin, float end) {
    if ((a * begin + b) * begin + c >= 0.0) return begin;
    float first = missed;
    float discriminant = b * b - 4.0 * a * c;
    if (abs(a) < 1e-12) {
        if (b != 0.0) first = -c / b;
        if (first < begin || first > end) first = missed;
    } else if (discriminant >= 0.0) {
        float q = -0.5 * (b + (b < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
        float one = q / a, other = q != 0.0 ? c / q : missed;
        if (one >= begin && one <= end) first = one;
        if (other >= begin && other <= end) first = min(first, other);
    }
    if (first == missed && (a * end + b) * end + c >= 0.0) first = end;  // a root lost to rounding
    return first;
}

// The gap d(t) − D(t) within one bilinear patch is a quadratic in t.
float hitInPatch(ivec2 patchPlace, vec3 from, vec3 way, float begin, float end) {
    ivec2 corner = patchPlace - 1;
    float base = depthOf(corner);
    float alongU = depthOf(corner + ivec2(1, 0)) - base, alongV = depthOf(corner + ivec2(0, 1)) - base;
    float twist = depthOf(corner + ivec2(1, 1)) - alongU - alongV - base;
    vec3 start = from + begin * way - vec3(corner, 0.0);  // relative to the patch, for float precision
    float a = -twist * way.x * way.y;
    float b = way.z - alongU * way.x - alongV * way.y - twist * (start.x * way.y + start.y * way.x);
    float c = start.z - base - alongU * start.x - alongV * start.y - twist * start.x * start.y;
    float hit = firstNotNegative(a, b, c, 0.0, end - begin);
    return hit == missed ? missed : begin + hit;
}

// Marches block by block through the pyramid. Skips a block whose minimum depth the ray does not reach, otherwise
// descends a level; at the finest level it solves the patch.
float firstHit(vec3 from, vec3 to) {
    vec3 way = to - from;
    vec2 start = from.xy + 1.0;  // patch (i, j) covers [i, i + 1] × [j, j + 1]
    ivec2 last = ivec2(texels);
    ivec2 place = clamp(ivec2(floor(start)), ivec2(0), last);
    bvec2 ahead = greaterThan(way.xy, vec2(0.0));
    vec2 inverse = 1.0 / mix(way.xy, vec2(1e-30), equal(way.xy, vec2(0.0)));
    float t = 0.0;
    int level = lastLevel;
    for (int n = 0; n < MOST_BLOCKS; ++n) {
        ivec2 block = place >> level;
        vec2 rim = vec2((block + ivec2(ahead)) << level);
        vec2 exits = mix((rim - start) * inverse, vec2(1e30), equal(way.xy, vec2(0.0)));
        float exit = max(t, min(min(exits.x, exits.y), 1.0));
        float deepest = max(from.z + t * way.z, from.z + exit * way.z);
        ivec4 own = levels[level];
        if (deepest >= blocks[own.x + block.y * own.y + block.x]) {
            if (level > 0) {
                --level;
                continue;
            }
            float hit = hitInPatch(place, from, way, t, exit);
            if (hit != missed) return hit;
        }
        if (exit >= 1.0) return missed;
        ivec2 first = block << level, beyond = (block + 1) << level;
        vec2 crossing = floor(start + exit * way.xy);
        ivec2 next = clamp(ivec2(crossing), first, beyond - 1);
        if (exits.x < exits.y) next.x = ahead.x ? beyond.x : first.x - 1;
        else next.y = ahead.y ? beyond.y : first.y - 1;
        if (any(lessThan(next, ivec2(0))) || any(greaterThan(next, last))) return missed;
        place = next;
        t = exit;
        level = min(level + 1, lastLevel);
    }
    return missed;
}
#endif
