// Colour and light of a point of the relief. Places and normals are in the frame of the relief.
uniform vec3 eye;  // in the panel's frame
uniform vec3 plate;  // half width, half height, depth; metres
uniform vec3 worldUp;  // in the panel's frame
uniform vec3 toSun;  // in the panel's frame
uniform vec3 sun, ambient, groundLight, haze, plateColour, dustColour;
uniform float hazePerMetre, pixelAngle;
layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D marks;  // worn, deposited, hit under the paper's ageing

vec3 toTexels(vec3 metres) {
    return vec3((metres.xy / (2.0 * plate.xy) + 0.5) * texels - 0.5, -metres.z / plate.z);
}

// Slope in texels, by central differences, so that the patches are not visible in the lighting.
vec2 slopeOf(ivec2 texel) {
    return 0.5 * vec2(depthOf(texel + ivec2(1, 0)) - depthOf(texel - ivec2(1, 0)),
                      depthOf(texel + ivec2(0, 1)) - depthOf(texel - ivec2(0, 1)));
}

vec3 normalAt(vec2 at) {
    ivec2 corner = ivec2(floor(at));
    vec2 share = at - floor(at);
    vec2 slope = mix(mix(slopeOf(corner), slopeOf(corner + ivec2(1, 0)), share.x),
                     mix(slopeOf(corner + ivec2(0, 1)), slopeOf(corner + ivec2(1, 1)), share.x), share.y);
    return normalize(vec3(slope * texels / (2.0 * plate.xy) * plate.z, 1.0));
}

// The level of detail follows from the distance. Derivatives are unusable, because neighbouring pixels may show other
// parts of the relief, or nothing.
vec3 albedoAt(vec3 metres, vec3 normal) {
    vec2 where = (toTexels(metres).xy + 0.5) / texels;
    vec3 sight = onPanel(metres) - eye;
    float slant = abs(dot(normalize(sight), normalOnPanel(metres, normal)));
    vec2 perPixel = pixelAngle * length(sight) * texels / (2.0 * plate.xy);
    float level = log2(max(perPixel.x, perPixel.y) / sqrt(max(slant, 0.05)));
    vec3 own = textureLod(colours, where, level).rgb;
    vec3 mark = textureLod(marks, where, level).rgb;
    // Where the surface is broken off, the plate's own colour shows, as at its rims, but paler.
    return mix(mix(mix(own, 1.2 * plateColour, mark.r), dustColour, mark.g), vec3(1.0), mark.b);
}

float sunShare(vec3 metres, vec3 normal) {
#ifdef SHADOW
    vec3 from = metres + normal * (0.02 * plate.z);
    vec3 there = directionInRelief(metres, toSun);  // straight also in a curved relief, since its shadows are short
    vec3 reach = (vec3(sign(there.xy) * plate.xy, 0.0) - from) / mix(there, vec3(1e-30), equal(there, vec3(0.0)));
    float way = min(min(reach.x, reach.y), reach.z);
    return way > 0.0 && firstHit(toTexels(from), toTexels(from + way * there)) != missed ? 0.0 : 1.0;
#else
    return 1.0;
#endif
}

#ifdef CAR_SHADOW
layout(binding = 2) uniform sampler2DShadow carShadow;
uniform mat4 panelToShadow;

// Points beyond the map's far end are behind the car: depths below 0 count as 0.
float pastCar(vec3 place) {
    vec3 at = (panelToShadow * vec4(place, 1.0)).xyz;
    return texture(carShadow, vec3(at.xy, max(at.z, 0.0)));
}
#else
float pastCar(vec3 place) { return 1.0; }
#endif

#ifdef DUST
float pastDust(vec3 place) { return dustShare(place); }
#else
float pastDust(vec3 place) { return 1.0; }
#endif

vec3 shaded(vec3 metres, vec3 normal, vec3 albedo) {
    vec3 place = onPanel(metres), upright = normalOnPanel(metres, normal);
    float facing = max(dot(upright, toSun), 0.0);
    float lit = facing > 0.0 ? sunShare(metres, normal) * pastCar(place) * pastDust(place) : 0.0;
    vec3 around = mix(groundLight, ambient, 0.5 + 0.5 * dot(upright, worldUp));
    vec3 light = albedo * (sun * (facing * lit) + around);
    float clear = exp(-hazePerMetre * distance(place, eye));
    return mix(haze, light, clear);
}
