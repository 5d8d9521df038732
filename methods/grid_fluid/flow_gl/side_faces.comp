// The speeds of the faces on the sides, as flow::setSideFaces: one side of the box for each z of the grid of threads.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };

const vec3 wind = WIND;
const int sides[6] = SIDES;  // as flow::Side: 0 open, 1 wall, 2 inflow

void main() {
    int side = int(gl_GlobalInvocationID.z), axis = side / 2;
    bool isFar = side % 2 == 1;
    ivec3 face = axis == 0 ? ivec3(0, gl_GlobalInvocationID.xy)
               : axis == 1 ? ivec3(gl_GlobalInvocationID.x, 0, gl_GlobalInvocationID.y)
                           : ivec3(gl_GlobalInvocationID.xy, 0);
    if (!inside(face)) return;
    if (isFar) face[axis] = cells[axis];
    int cell = at(face), next = cell + (isFar ? -1 : 1) * stepAlong(axis);
    float speed = sides[side] == 2 ? wind[axis] : sides[side] == 0 ? moving[next][axis] : 0.0;
    // Other threads write the other components.
    if (axis == 0) moving[cell].x = speed;
    else if (axis == 1) moving[cell].y = speed;
    else moving[cell].z = speed;
}
