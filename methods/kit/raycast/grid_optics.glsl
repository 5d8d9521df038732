// Optical properties of a grid of cells: density, light and fire at any position.
//
// Lengths are in cells; positions are relative to the grid's minimum corner.
// SPARSE: the densities are stored elsewhere; the code that defines it first defines densityAt() and reactionAt().
#ifndef SPARSE
layout(binding = 1) uniform sampler3D density;
#endif
#ifdef FIRE
#ifndef SPARSE
layout(binding = 3) uniform sampler3D reaction;
#endif
layout(binding = 4) uniform sampler2D fire;  // emission and extinction factor by reaction
#endif
#ifdef SHADOW
layout(binding = 5) uniform sampler3D light;  // fraction of the sun's light that arrives
uniform vec3 lightCells;  // range that the light texture covers
uniform vec3 reflectedSky, reflectedSun;
uniform vec3 toSun;
uniform float asymmetry;

// The factor on the sun's light for a ray in this direction from the eye, as scene::phaseFactor.
float phaseOf(vec3 along) {
    float square = 1.0 + asymmetry * (asymmetry - 2.0 * dot(along, toSun));
    return (1.0 - asymmetry * asymmetry) / (square * sqrt(square));
}
#else
uniform vec3 reflected;  // light reflected by a thick cloud
#endif
#if defined(FIRE) || defined(SHADOW)
#define COLOURED
#endif

#ifndef SPARSE
uniform vec3 cells;
#endif
uniform float extinction;  // of a density of 1, per cell

#ifdef SPARSE
// Nothing; see above.
#elif defined(NEAREST)
float sampled(sampler3D field, vec3 at) {
    return texelFetch(field, clamp(ivec3(floor(at)), ivec3(0), ivec3(cells) - 1), 0).r;
}
#elif defined(CUBIC)
// Evaluates a cubic B-spline with eight linear samples instead of 64 cells, by merging the weights along each axis
// into two pairs. Source: Sigg2005.
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

#ifndef SPARSE
float densityAt(vec3 at) {
    return sampled(density, at);
}
#ifdef FIRE
float reactionAt(vec3 at) {
    return sampled(reaction, at);
}
#endif
#endif

// Returns the extinction per cell; `source` receives the colour that smoke and fire show on a ray with this phase.
float extinctionAt(vec3 at, float phase, out vec3 source) {
#ifdef SHADOW
    source = reflectedSky + reflectedSun * (phase * texture(light, at / lightCells).r);
#else
    source = reflected;
#endif
    float found = densityAt(at) * extinction;
#ifdef FIRE
    vec4 burning = texture(fire, vec2((reactionAt(at) * (FIRE_TEXELS - 1.0) + 0.5) / FIRE_TEXELS, 0.5));
    found *= burning.a;
    source += burning.rgb;
#endif
    return found;
}
