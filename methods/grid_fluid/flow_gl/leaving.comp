// Records the density that leaves the box in a step through each face of the two sides across one axis: the distance
// that it travels in cells, and the density summed over cells.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict writeonly buffer Faces { vec2 faces[]; };
uniform int axis;
uniform int first;            // of this axis among all faces
uniform float cellsPerSpeed;  // dt/h

void main() {
    int b = (axis + 1) % 3, c = (axis + 2) % 3;
    ivec3 face = ivec3(gl_GlobalInvocationID);
    if (face.x >= cells[b] || face.y >= cells[c] || face.z > 1) return;
    bool far = face.z == 1;
    ivec3 place;
    place[axis] = far ? cells[axis] - 1 : 0;
    place[b] = face.x;
    place[c] = face.y;
    int cell = at(place), beyond = cell + (far ? stepAlong(axis) : -stepAlong(axis));
    float reach = max((far ? moving[beyond][axis] : -moving[cell][axis]) * cellsPerSpeed, 0.0);
    if (conductance(beyond) != 2u) reach = 0.0;
    faces[first + face.x + cells[b] * (face.y + cells[c] * face.z)] = vec2(reach, reach * moving[cell].w);
}
