// A relief by ray casting: the first hit of the ray through this pixel, its shading and its depth.
in vec3 place;

uniform mat4 panelToClip;

layout(location = 0) out vec4 colour;

void main() {
    if (gl_FrontFacing) discard;  // each ray once, at its exit from the plate
    vec3 way = place - eye;
    vec3 toLow = (vec3(-plate.xy, -plate.z) - eye) / way, toHigh = (vec3(plate.xy, 0.0) - eye) / way;
    vec3 entries = min(toLow, toHigh), exits = max(toLow, toHigh);
    float enter = max(max(max(entries.x, entries.y), entries.z), 0.0), leave = min(min(exits.x, exits.y), exits.z);
    if (enter >= leave) discard;

    vec3 from = eye + enter * way, to = eye + leave * way;
    if (leave == exits.z) to.z = way.z < 0.0 ? -plate.z : 0.0;  // exact, since the surface may be at the bottom
    float t = firstHit(toTexels(from), toTexels(to));
    if (t == missed || (t == 0.0 && enter == 0.0)) discard;  // an eye within the solid sees through it
    vec3 metres = from + t * (to - from);
    vec3 at = toTexels(metres);

    // If the ray starts inside the plate, it sees the back or a rim.
    bool cut = t == 0.0 && enter > 0.0 && enter > entries.z;
    bool back = t == 0.0 && eye.z < -plate.z && enter == entries.z;
    vec3 normal = normalAt(at.xy), albedo;
    if (back) normal = vec3(0.0, 0.0, -1.0);
    else if (cut) normal = entries.x > entries.y ? vec3(-sign(way.x), 0.0, 0.0) : vec3(0.0, -sign(way.y), 0.0);
    albedo = back || cut ? plateColour : albedoAt(metres, normal);

    colour = vec4(shaded(metres, normal, albedo), 1.0);
    vec4 clip = panelToClip * vec4(metres, 1.0);
    gl_FragDepth = clip.z / clip.w;
}
