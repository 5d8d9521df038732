// Confinement, buoyancy, weight and decay, as in flow::applyForces.
// Source: Fedkiw2001, Eq. 8 and 11; Senger2009, Eq. 7.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
#ifdef CONFINED
layout(std430, binding = 5) restrict readonly buffer Curl { vec4 curl[]; };
uniform float strength;  // confinement times spacing and step
#endif
uniform float lift, weight, keptDensity, keptHeat, lost;

const float nothing = 1e-18;  // smaller values are set to 0

#ifdef CONFINED
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
    if (!inside(c) || !isFluid(at(c))) return;
    vec4 old = moving[at(c)];
    vec2 burning = carried[at(c)];
    vec3 force = vec3(0, lift * burning.x - weight * old.w, 0);
#ifdef CONFINED
    force += confinement(c);
#endif
    vec4 now = vec4(old.xyz + force, old.w * keptDensity);
    vec2 left = vec2(burning.x * keptHeat, burning.y - lost);
    moving[at(c)] = mix(now, vec4(0), lessThanEqual(abs(now), vec4(nothing)));
    left = mix(left, vec2(0), lessThanEqual(abs(left), vec2(nothing)));
    carried[at(c)] = vec2(left.x, max(left.y, 0.0));
}
