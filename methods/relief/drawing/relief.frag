// A relief by ray casting: the first hit of the ray through this pixel, its shading and its depth.
in vec3 place;

uniform mat4 panelToClip;

layout(location = 0) out vec4 colour;

struct Found {
    vec3 metres;  // in the frame of the relief
    vec3 way;
    bool cut;   // the ray enters the solid through a rim,
    bool back;  // or from behind
    bool alongX;  // the rim is at either end of the columns
};

// Follows a straight line in the frame of the relief, from `start` on; `last`: its end as a multiple of `way`.
// `inside`: the line begins at the eye.
bool followed(vec3 start, vec3 way, float last, bool inside, out Found found) {
    vec3 toLow = (vec3(-plate.xy, -plate.z) - start) / way, toHigh = (vec3(plate.xy, 0.0) - start) / way;
    vec3 entries = min(toLow, toHigh), exits = max(toLow, toHigh);
    float enter = max(max(max(entries.x, entries.y), entries.z), 0.0), leave = min(min(exits.x, exits.y), exits.z);
    leave = min(leave, last);
    if (enter >= leave) return false;

    vec3 from = start + enter * way, to = start + leave * way;
    if (leave == exits.z) to.z = way.z < 0.0 ? -plate.z : 0.0;  // exact, since the surface may be at the bottom
    float t = firstHit(toTexels(from), toTexels(to));
    if (t == missed || (t == 0.0 && inside && enter == 0.0)) return false;  // an eye within the solid sees through it
    found.metres = from + t * (to - from);
    found.way = way;
    // If the ray starts inside the plate, it sees the back or a rim.
    found.cut = t == 0.0 && enter > 0.0 && enter > entries.z;
    found.back = t == 0.0 && start.z < -plate.z && enter == entries.z;
    found.alongX = entries.x > entries.y;
    return true;
}

#ifdef CURVED
uniform vec3 boxLow, boxHigh;  // around the plate, in the panel's frame

// In the frame of the relief the ray is a curve, which is followed along its chords. Source: Oliveira2005.
bool traced(vec3 way, out Found found) {
    vec3 toLow = (boxLow - eye) / way, toHigh = (boxHigh - eye) / way;
    vec3 entries = min(toLow, toHigh), exits = max(toLow, toHigh);
    float enter = max(max(max(entries.x, entries.y), entries.z), 0.0), leave = min(min(exits.x, exits.y), exits.z);
    if (enter >= leave) return false;
    vec3 first = eye + enter * way;
    vec3 from = toRelief(first, toRelief(first, vec3(first.xy, 0.0)));
    for (int k = 1; k <= CHORDS; ++k) {
        vec3 to = toRelief(eye + mix(enter, leave, float(k) / float(CHORDS)) * way, from);
        if (followed(from, to - from, 1.0, k == 1 && enter == 0.0, found)) return true;
        from = to;
    }
    return false;
}
#else
bool traced(vec3 way, out Found found) { return followed(eye, way, 3.4e38, true, found); }
#endif

void main() {
    if (gl_FrontFacing) discard;  // each ray once, at its exit from the plate
    Found found;
    if (!traced(place - eye, found)) discard;
    vec3 at = toTexels(found.metres);
    vec3 normal = normalAt(at.xy), albedo;
    if (found.back) normal = vec3(0.0, 0.0, -1.0);
    else if (found.cut) normal = found.alongX ? vec3(-sign(found.way.x), 0.0, 0.0) : vec3(0.0, -sign(found.way.y), 0.0);
    albedo = found.back || found.cut ? plateColour : albedoAt(found.metres, normal);

    colour = vec4(shaded(found.metres, normal, albedo), 1.0);
    vec4 clip = panelToClip * vec4(onPanel(found.metres), 1.0);
    gl_FragDepth = clip.z / clip.w;
}
