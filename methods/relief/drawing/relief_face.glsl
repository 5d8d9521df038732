// The face of a panel: from the frame of its relief to the panel's, which differ if it is curved.
// kit/meshes/curved_panel.cpp is the reference.
#ifdef CURVED
uniform vec2 curvature;

vec3 acrossFace(vec2 at) { return vec3(curvature * at, 1.0); }

vec3 onPanel(vec3 relief) {
    vec2 at = relief.xy;
    return vec3(at, -0.5 * dot(curvature, at * at)) + relief.z * normalize(acrossFace(at));
}

mat3 axesAt(vec3 relief) {
    vec3 across = acrossFace(relief.xy);
    float size = length(across);
    vec3 normal = across / size;
    vec3 alongX = vec3(curvature.x, 0.0, 0.0), alongY = vec3(0.0, curvature.y, 0.0);
    return mat3(vec3(1.0, 0.0, -across.x) + relief.z / size * (alongX - normal * dot(normal, alongX)),
                vec3(0.0, 1.0, -across.y) + relief.z / size * (alongY - normal * dot(normal, alongY)), normal);
}

// `guess`: a place nearby.
vec3 toRelief(vec3 place, vec3 guess) {
    vec3 relief = guess;
    for (int step = 0; step < 3; ++step) relief += inverse(axesAt(relief)) * (place - onPanel(relief));
    return relief;
}

vec3 normalOnPanel(vec3 relief, vec3 normal) { return normalize(normal * inverse(axesAt(relief))); }
vec3 directionInRelief(vec3 relief, vec3 direction) { return normalize(inverse(axesAt(relief)) * direction); }
#else
vec3 onPanel(vec3 relief) { return relief; }
vec3 normalOnPanel(vec3 relief, vec3 normal) { return normal; }
vec3 directionInRelief(vec3 relief, vec3 direction) { return direction; }
#endif
