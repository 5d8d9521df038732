// Front to back along the pixel's ray through a grid of cells.
//
//     D ← D + σ·Δ,   T = e^(−D),   C ← C + (T before − T after)·(reflected + emission)
//
// Steps end at distances (k + jitter)·step from the eye, on whatever side of the grid it is; the first and the last are
// cut to what lies within the grid and before the scene, and each is sampled in its middle.
// Source: Senger2009, ch. 4. Departs: entry, length and their cuts are computed for each pixel instead of drawn first.
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 1) uniform sampler3D density;
#ifdef SKIP
layout(binding = 2) uniform sampler3D bricks;  // 0: nothing in it
#endif
#ifdef FIRE
layout(binding = 3) uniform sampler3D reaction;
layout(binding = 4) uniform sampler2D fire;  // emission and extinction factor by reaction
#endif
#ifdef SHADOW
layout(binding = 5) uniform sampler3D light;  // how much of the sun's comes through
uniform vec3 lightCells;                      // that it reaches over
uniform vec3 reflectedSky, reflectedSun;
#else
uniform vec3 reflected;  // what a thick cloud reflects
#endif
#if defined(FIRE) || defined(SHADOW)
#define COLOURED
#endif

// Lengths are in cells, places from the grid's least corner.
uniform vec3 cells, eye;
#ifdef SKIP
uniform vec3 least, most;  // [least, most) holds all there is
#endif
uniform vec3 rayCorner, rayRight, rayUp;  // the ray through the picture's corner, and what one pixel adds
uniform float nearDistance, stepLength;
uniform float extinction;   // of a density of 1, per cell
uniform float opaqueDepth;  // where a ray may end

layout(location = 0) out vec4 colour;

#ifdef CUBIC
// Eight linear samples make a cubic B-spline's 64: along each axis the two outer pairs of weights are put together.
// Source: Sigg2005.
float sampled(sampler3D field, vec3 at) {
    vec3 place = at - 0.5, share = fract(place), low = place - share;
    vec3 rest = 1.0 - share;
    vec3 w0 = rest * rest * rest / 6.0;
    vec3 w1 = 2.0 / 3.0 - 0.5 * share * share * (2.0 - share);
    vec3 w3 = share * share * share / 6.0;
    vec3 w2 = 1.0 - w0 - w1 - w3;
    vec3 g0 = w0 + w1, g1 = w2 + w3;
    vec3 h0 = (low - 0.5 + w1 / g0) / cells, h1 = (low + 1.5 + w3 / g1) / cells;
    vec4 front = vec4(texture(field, vec3(h0.x, h0.y, h0.z)).r, texture(field, vec3(h1.x, h0.y, h0.z)).r,
                      texture(field, vec3(h0.x, h1.y, h0.z)).r, texture(field, vec3(h1.x, h1.y, h0.z)).r);
    vec4 back = vec4(texture(field, vec3(h0.x, h0.y, h1.z)).r, texture(field, vec3(h1.x, h0.y, h1.z)).r,
                     texture(field, vec3(h0.x, h1.y, h1.z)).r, texture(field, vec3(h1.x, h1.y, h1.z)).r);
    vec4 all = g0.z * front + g1.z * back;
    return g0.y * (g0.x * all.x + g1.x * all.y) + g1.y * (g0.x * all.z + g1.x * all.w);
}
#else
float sampled(sampler3D field, vec3 at) {
    return texture(field, at / cells).r;
}
#endif

// pixel_rays.h says what it is.
float jitter() {
#ifdef JITTER
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    return float((pixel.x * 3242174889u + pixel.y * 2447445414u) >> 8) * exp2(-24.0);
#else
    return 0.0;
#endif
}

float depth = 0.0;
#ifdef COLOURED
float transmittance = 1.0;
vec3 shown = vec3(0);
#endif

void march(vec3 at, float reach) {
    float step = sampled(density, at) * extinction * reach;
#ifdef COLOURED
#ifdef SHADOW
    vec3 source = reflectedSky + reflectedSun * texture(light, at / lightCells).r;
#else
    vec3 source = reflected;
#endif
#ifdef FIRE
    vec4 burning = texture(fire, vec2((sampled(reaction, at) * (FIRE_TEXELS - 1.0) + 0.5) / FIRE_TEXELS, 0.5));
    step *= burning.a;
    source += burning.rgb;
#endif
    float left = exp(-depth - step);
    shown += (transmittance - left) * source;
    transmittance = left;
#endif
    depth += step;
}

// Where the ray from the eye is between two corners: x to y.
vec2 within(vec3 low, vec3 high, vec3 perRay) {
    vec3 atLow = (low - eye) * perRay, atHigh = (high - eye) * perRay;
    vec3 enters = min(atLow, atHigh), leaves = max(atLow, atHigh);
    return vec2(max(max(enters.x, enters.y), max(enters.z, 0.0)), min(min(leaves.x, leaves.y), leaves.z));
}

#ifdef SKIP
// How far a ray goes through bricks without anything in them, `length` at the most.
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

    vec2 box = within(vec3(0), cells, perRay);
    float end = min(box.y, nearDistance / max(texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, 1e-9) * stretch);
#ifdef SKIP
    vec2 filled = within(least, most, perRay);
    float enter = filled.x, last = min(filled.y, end);
    if (enter >= last) return;
    enter += clearAhead(eye + enter * ray, ray, last - enter);
    if (enter >= last) return;
    last -= clearAhead(eye + last * ray, -ray, last - enter);
#else
    float enter = box.x, last = end;
#endif
    if (enter >= last) return;

    float shift = jitter() * stepLength;
    float k = floor((enter - shift) / stepLength) + 1.0;  // the step from `from` ends at `next`, or at the end
    float next = k * stepLength + shift, from = max(next - stepLength, box.x);
    while (from < last && depth <= opaqueDepth) {
        float to = min(next, end);
        march(eye + 0.5 * (from + to) * ray, to - from);
        from = to;
        k += 1.0;
        next = k * stepLength + shift;
    }
    float alpha = 1.0 - exp(-depth);
#ifdef COLOURED
    colour = vec4(shown, alpha);
#else
    colour = vec4(reflected * alpha, alpha);
#endif
}
