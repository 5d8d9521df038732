// Copies one quantity of all cells, without ghosts, to an array, or to a 3D texture for display, where values below 0
// become 0. A cell's velocity is the mean of its two faces.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
#ifdef TEXTURE
layout(binding = 0, r32f) restrict writeonly uniform image3D picture;
#else
layout(std430, binding = 3) restrict writeonly buffer Values { float values[]; };
#endif
uniform int lane;
#ifndef TEXTURE
uniform int asStored;  // a velocity on the face towards -x, -y or -z
#else
const int asStored = 0;
#endif

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    float value = lane < 4 ? moving[cell][lane] : carried[cell][lane - 4];
    if (lane < 3 && asStored == 0) value = 0.5 * (value + moving[cell + stepAlong(lane)][lane]);
#ifdef TEXTURE
    imageStore(picture, c, vec4(max(value, 0)));
#else
    values[c.x + cells.x * (c.y + cells.y * c.z)] = value;
#endif
}
