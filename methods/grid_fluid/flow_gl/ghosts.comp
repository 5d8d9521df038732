// Fills the ghosts as flow::fillGhosts does: one side of the box for each z of the grid of threads. The faces on the far sides,
// which are stored in the ghosts there, do not change.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
uniform int noSlip;

const vec3 wind = WIND;
const int sides[6] = SIDES;  // as flow::Side: 0 open, 1 wall, 2 inflow

int sideOf(ivec3 c, int axis) {
    return c[axis] < 0 ? sides[2 * axis] : c[axis] >= cells[axis] ? sides[2 * axis + 1] : -1;
}

// The speed across `lane` beyond the box; on the face of a far side it continues along the side.
float speedBeyond(ivec3 c, int lane) {
    ivec3 from = clamp(c, ivec3(0), cells - 1);
    bool isFar = c[lane] == cells[lane];
    if (isFar) from[lane] = cells[lane];
    else if (sideOf(c, lane) == 1) from[lane] = 1;  // mirrored
    float speed = moving[at(from)][lane];
    for (int axis = 0; axis < 3; ++axis) {
        int side = sideOf(c, axis);
        if (side < 0 || (isFar && (axis == lane || axis < 2))) continue;
        if (side == 2) speed = wind[lane];
        else if (side == 1 && (axis == lane || noSlip != 0)) speed = -speed;
    }
    return speed;
}

void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    int side = int(gl_GlobalInvocationID.z), axis = side / 2;
    // Edges and corners belong to the last axis along which they are outside.
    ivec3 c = axis == 0 ? ivec3(0, place) : axis == 1 ? ivec3(place.x - 1, 0, place.y) : ivec3(place - 1, 0);
    c[axis] = side % 2 == 0 ? -1 : cells[axis];
    ivec3 low = ivec3(-1, axis == 0 ? 0 : -1, axis == 2 ? -1 : 0);
    ivec3 high = ivec3(cells.x, axis == 0 ? cells.y - 1 : cells.y, axis == 2 ? cells.z : cells.z - 1);
    if (any(lessThan(c, low)) || any(greaterThan(c, high))) return;
    int nearest = at(clamp(c, ivec3(0), cells - 1));
    bool isClear = false;
    for (int a = 0; a < 3; ++a) isClear = isClear || sideOf(c, a) == 0 || sideOf(c, a) == 2;
    vec3 speed = vec3(speedBeyond(c, 0), speedBeyond(c, 1), speedBeyond(c, 2));
    moving[at(c)] = vec4(speed, isClear ? 0.0 : moving[nearest].w);
    carried[at(c)] = isClear ? vec2(0) : carried[nearest];
}
