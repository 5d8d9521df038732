// Adds the contributions of all sources in sequence: at the centres of fluid cells, and on the faces between them.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
layout(std430, binding = 4) restrict readonly buffer Added { float added[]; };
uniform int count;
uniform ivec3 minimum;  // of all cells that any source reaches

void main() {
    ivec3 c = minimum + ivec3(gl_GlobalInvocationID);
    if (!inside(c) || !isFluid(at(c))) return;
    vec4 record = moving[at(c)];
    vec2 burning = carried[at(c)];
    bool reached = false;
    for (int s = 0; s < count; ++s) {
        if (any(lessThan(c, sources[s].first.xyz)) || any(greaterThan(c, sources[s].last.xyz))) continue;
        reached = true;
        float strength = strengthAt(vec3(c), s);
        record.w += strength * added[s];
        burning.x += strength * sources[s].kelvin;
        burning.y = max(burning.y, strength * sources[s].reaction);
        for (int axis = 0; axis < 3; ++axis) {
            if (!moves(at(c), axis)) continue;
            vec3 face = vec3(c);
            face[axis] -= 0.5;
            float taken = strengthAt(face, s) * sources[s].velocity.w;
            record[axis] += taken * (sources[s].velocity[axis] - record[axis]);
        }
    }
    if (!reached) return;
    moving[at(c)] = record;
    carried[at(c)] = burning;
}
