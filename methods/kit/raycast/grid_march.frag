// Marches front to back along the pixel's ray through a grid of cells.
//
//     D ← D + σ·Δ,   T = e^(−D),   C ← C + (T before − T after)·(reflected + emission)
//
// Steps end at distances (k + jitter)·step from the eye on either side of the grid. The first and the last step are
// cut to the part within the grid and in front of the scene. Each step is sampled at its middle.
// Source: Senger2009, ch. 4. Departs: computes entry, length and cuts per pixel instead of drawing them first.
layout(binding = 0) uniform sampler2D sceneDepth;
// SPARSE: the code that defines it (grid_optics.glsl) also defines stepsClear(), which then skips empty space.
#ifdef SKIP
#ifndef SPARSE
layout(binding = 2) uniform sampler3D bricks;  // 0: empty
#endif
uniform vec3 minimum, maximum;  // [minimum, maximum) contains all density
#endif

uniform vec3 eye;
uniform vec3 rayCorner, rayRight, rayUp;  // the ray through the image's corner, and its change per pixel
uniform float nearDistance, stepLength;
uniform float opaqueDepth;  // where rays end

layout(location = 0) out vec4 colour;

// See shown_grid.h.
float jitter() {
#ifdef JITTER
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    return float((pixel.x * 3242174889u + pixel.y * 2447445414u) >> 8) * exp2(-24.0);
#else
    return 0.0;
#endif
}

float depth = 0.0;
float phase = 1.0;
#ifdef COLOURED
float transmittance = 1.0;
vec3 shown = vec3(0);
#endif

void march(vec3 at, float reach) {
    vec3 source;
    float next = depth + extinctionAt(at, phase, source) * reach;
#ifdef COLOURED
    float left = exp(-next);
    shown += (transmittance - left) * source;
    transmittance = left;
#endif
    depth = next;
}

// The distances x to y at which the ray from the eye is between two corners.
vec2 within(vec3 low, vec3 high, vec3 perRay) {
    vec3 atLow = (low - eye) * perRay, atHigh = (high - eye) * perRay;
    vec3 enters = min(atLow, atHigh), leaves = max(atLow, atHigh);
    return vec2(max(max(enters.x, enters.y), max(enters.z, 0.0)), min(min(leaves.x, leaves.y), leaves.z));
}

#if defined(SKIP) && !defined(SPARSE)
// Distance that a ray travels through empty bricks, at most `length`.
float clearAhead(vec3 start, vec3 ray, float length) {
    vec3 perRay = 1.0 / ray;
    ivec3 brickCount = textureSize(bricks, 0);
    ivec3 brick = clamp(ivec3(start / BRICK), ivec3(0), brickCount - 1);
    ivec3 toward = ivec3(sign(ray));
    vec3 perBrick = BRICK * abs(perRay);
    vec3 exits = (vec3(brick + max(toward, 0)) * BRICK - start) * perRay;
    float ahead = 0.0;
    while (texelFetch(bricks, brick, 0).r == 0.0) {
        ahead = min(min(exits.x, exits.y), exits.z);
        bvec3 through = lessThanEqual(exits, vec3(ahead));
        exits += mix(vec3(0), perBrick, through);
        brick += ivec3(through) * toward;
        if (ahead >= length || any(lessThan(brick, ivec3(0))) || any(greaterThanEqual(brick, brickCount)))
            return length;
    }
    return max(ahead, 0.0);
}
#endif

void main() {
    colour = vec4(0);
    vec3 ray = rayCorner + gl_FragCoord.x * rayRight + gl_FragCoord.y * rayUp;
    float stretch = length(ray);
    ray /= stretch;
    ray = mix(ray, vec3(1e-12), lessThan(abs(ray), vec3(1e-12)));  // finite quotients
    vec3 perRay = 1.0 / ray;
#ifdef SHADOW
    phase = phaseOf(ray);
#endif

    vec2 box = within(vec3(0), cells, perRay);
    float end = min(box.y, nearDistance / max(texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, 1e-9) * stretch);
#ifdef SKIP
    vec2 filled = within(minimum, maximum, perRay);
    float enter = filled.x, last = min(filled.y, end);
    if (enter >= last) return;
#ifndef SPARSE
    enter += clearAhead(eye + enter * ray, ray, last - enter);
    if (enter >= last) return;
    last -= clearAhead(eye + last * ray, -ray, last - enter);
#endif
#else
    float enter = box.x, last = end;
#endif
    if (enter >= last) return;

    float shift = jitter() * stepLength;
    float k = floor((enter - shift) / stepLength) + 1.0;  // the step that starts at `from` ends at `next` or `end`
    float next = k * stepLength + shift, from = max(next - stepLength, box.x);
    // Counted, because the loop would not end at large distances, where float precision cannot separate steps.
    for (int steps = int((last - enter) / stepLength) + 3; steps > 0 && from < last && depth <= opaqueDepth; --steps) {
        float to = min(next, end);
        march(eye + 0.5 * (from + to) * ray, to - from);
        from = to;
        k += 1.0;
        next = k * stepLength + shift;
#if defined(SKIP) && defined(SPARSE)
        // Whole steps, so that later steps are where they would be without skipping.
        int clear = stepsClear(eye + from * ray, ray, stepLength);
        if (clear > 0) {
            steps -= clear;
            k += float(clear);
            next = k * stepLength + shift;
            from = (k - 1.0) * stepLength + shift;
        }
#endif
    }
    float alpha = 1.0 - exp(-depth);
#ifdef COLOURED
    colour = vec4(shown, alpha);
#else
    colour = vec4(reflected * alpha, alpha);
#endif
}
