// Fills the ghosts as flow::fillGhosts does: one side of the box for each z of the grid of threads.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
uniform vec3 wind;
uniform int noSlip, forFaces;

const int sides[6] = SIDES;  // as flow::Side: 0 open, 1 wall, 2 inflow

void goBeyond(int side, inout vec4 inner, inout vec2 innerCarried) {
    int axis = side / 2;
    if (sides[side] == 2) {
        inner = vec4(wind, 0);
        innerCarried = vec2(0);
    } else if (sides[side] == 0) {
        inner.w = 0.0;
        innerCarried = vec2(0);
    } else {
        float across = forFaces != 0 ? 0.0 : -inner[axis];
        if (noSlip != 0) inner.xyz = -inner.xyz;
        inner[axis] = across;
    }
}

void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    int side = int(gl_GlobalInvocationID.z), axis = side / 2;
    // Edges and corners belong to the last axis along which they lie outside.
    ivec3 c = axis == 0 ? ivec3(0, place) : axis == 1 ? ivec3(place.x - 1, 0, place.y) : ivec3(place - 1, 0);
    c[axis] = side % 2 == 0 ? -1 : cells[axis];
    ivec3 low = ivec3(-1, axis == 0 ? 0 : -1, axis == 2 ? -1 : 0);
    ivec3 high = ivec3(cells.x, axis == 0 ? cells.y - 1 : cells.y, axis == 2 ? cells.z : cells.z - 1);
    if (any(lessThan(c, low)) || any(greaterThan(c, high))) return;
    ivec3 nearest = clamp(c, ivec3(0), cells - 1);
    vec4 inner = moving[at(nearest)];
    vec2 innerCarried = carried[at(nearest)];
    for (int a = 0; a < 3; ++a)
        if (c[a] != nearest[a]) goBeyond(2 * a + (c[a] < 0 ? 0 : 1), inner, innerCarried);
    moving[at(c)] = inner;
    carried[at(c)] = innerCarried;
}
