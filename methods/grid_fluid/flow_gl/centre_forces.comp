// Computes the changes of speed at each cell's centre by confinement, buoyancy and weight, as in flow::applyForces.
// Source: Fedkiw2001, Eq. 8 and 11.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 6) restrict writeonly buffer Force { vec4 force[]; };
uniform float lift, weight;
#ifdef CONFINED
layout(std430, binding = 5) restrict readonly buffer Curl { vec4 curl[]; };
uniform float strength;  // confinement times spacing and step

// Beyond the box |w| is extended.
float curlAt(ivec3 c) {
    return curl[at(clamp(c, ivec3(0), cells - 1))].w;
}

vec3 confinement(ivec3 c) {
    vec3 g = vec3(curlAt(c + ivec3(1, 0, 0)) - curlAt(c - ivec3(1, 0, 0)),
                  curlAt(c + ivec3(0, 1, 0)) - curlAt(c - ivec3(0, 1, 0)),
                  curlAt(c + ivec3(0, 0, 1)) - curlAt(c - ivec3(0, 0, 1)));
    return strength / sqrt(dot(g, g) + 1e-20) * cross(g, curl[at(c)].xyz);
}
#endif

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    float up = lift * carried[cell].x - weight * moving[cell].w;
#ifdef CONFINED
    force[cell] = vec4(confinement(c), up);  // for spread.comp
#else
    force[cell] = vec4(0, up, 0, 0);
#endif
}
