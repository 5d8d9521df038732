// Moves all quantities by whole cells; new cells and faces start with the wind.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 3) restrict writeonly buffer MovingThen { vec4 movingThen[]; };
layout(std430, binding = 4) restrict writeonly buffer CarriedThen { vec2 carriedThen[]; };
uniform ivec3 by;
uniform vec3 wind;

// The records behind the last cells hold faces of one axis each.
bool hadFace(ivec3 c, int axis) {
    ivec3 end = cells;
    end[axis] += 1;
    return all(greaterThanEqual(c, ivec3(0))) && all(lessThan(c, end));
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!insideOrFar(c)) return;
    ivec3 from = c + by;
    vec4 value = vec4(wind, inside(from) ? moving[at(from)].w : 0.0);
    for (int axis = 0; axis < 3; ++axis)
        if (hadFace(from, axis)) value[axis] = moving[at(from)][axis];
    movingThen[at(c)] = value;
    carriedThen[at(c)] = inside(from) ? carried[at(from)] : vec2(0);
}
