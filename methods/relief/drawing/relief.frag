// A relief by ray casting: the first hit of the ray through this pixel, its shading and its depth.
in vec3 place;

uniform vec3 eye;  // in the panel's frame
uniform vec3 plate;
uniform mat4 panelToClip;
uniform vec3 worldUp;  // in the panel's frame
uniform vec3 toSun;  // in the panel's frame
uniform vec3 sun, ambient, groundLight, haze, plateColour, dustColour;
uniform float hazePerMetre;
layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D marks;  // worn, laid on, hit under the paper's ageing

layout(location = 0) out vec4 colour;

vec3 toTexels(vec3 metres) {
    return vec3((metres.xy / (2.0 * plate.xy) + 0.5) * texels - 0.5, -metres.z / plate.z);
}

// Slope in texels, by central differences, so that light does not show the patches.
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

vec3 albedoAt(vec2 at) {
    vec2 where = (at + 0.5) / texels;
    vec3 own = texture(colours, where).rgb;
    vec3 mark = texture(marks, where).rgb;
    vec3 fresh = mix(own, vec3(dot(own, vec3(0.2126, 0.7152, 0.0722))), 0.35) * 1.35;  // a broken surface is paler
    return mix(mix(mix(own, fresh, mark.r), dustColour, mark.g), vec3(1.0), mark.b);
}

float sunShare(vec3 metres, vec3 normal) {
#ifdef SHADOW
    vec3 from = metres + normal * (0.02 * plate.z);
    vec3 reach = (vec3(sign(toSun.xy) * plate.xy, 0.0) - from) / mix(toSun, vec3(1e-30), equal(toSun, vec3(0.0)));
    float way = min(min(reach.x, reach.y), reach.z);
    return way > 0.0 && firstHit(toTexels(from), toTexels(from + way * toSun)) != missed ? 0.0 : 1.0;
#else
    return 1.0;
#endif
}

void main() {
    if (gl_FrontFacing) discard;  // each ray once, at its exit from the plate
    vec3 way = place - eye;
    vec3 toLow = (vec3(-plate.xy, -plate.z) - eye) / way, toHigh = (vec3(plate.xy, 0.0) - eye) / way;
    vec3 entries = min(toLow, toHigh);
    float enter = clamp(max(max(entries.x, entries.y), entries.z), 0.0, 1.0);

    vec3 from = eye + enter * way;
    float t = firstHit(toTexels(from), toTexels(place));
    if (t == missed) discard;
    vec3 metres = from + t * (place - from);
    vec3 at = toTexels(metres);

    // If the ray starts inside the plate, it sees the back or a rim.
    bool cut = t == 0.0 && enter > 0.0 && enter > entries.z;
    bool back = t == 0.0 && eye.z < -plate.z && enter == entries.z;
    vec3 normal = normalAt(at.xy), albedo;
    if (back) normal = vec3(0.0, 0.0, -1.0);
    else if (cut) normal = entries.x > entries.y ? vec3(-sign(way.x), 0.0, 0.0) : vec3(0.0, -sign(way.y), 0.0);
    albedo = back || cut ? plateColour : albedoAt(at.xy);

    float facing = max(dot(normal, toSun), 0.0);
    float lit = facing > 0.0 ? sunShare(metres, normal) : 0.0;
    vec3 around = mix(groundLight, ambient, 0.5 + 0.5 * dot(normal, worldUp));
    vec3 light = albedo * (sun * (facing * lit) + around);
    float clear = exp(-hazePerMetre * distance(metres, eye));
    colour = vec4(mix(haze, light, clear), 1.0);
    vec4 clip = panelToClip * vec4(metres, 1.0);
    gl_FragDepth = clip.z / clip.w;
}
