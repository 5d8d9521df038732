// Copies one quantity of all cells, without ghosts, to a 3D texture or to an array.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
#ifdef TEXTURE
layout(binding = 0, r32f) restrict writeonly uniform image3D picture;
#else
layout(std430, binding = 3) restrict writeonly buffer Values { float values[]; };
#endif
uniform int lane;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    float value = lane < 4 ? moving[at(c)][lane] : carried[at(c)][lane - 4];
#ifdef TEXTURE
    imageStore(picture, c, vec4(value));
#else
    values[c.x + cells.x * (c.y + cells.y * c.z)] = value;
#endif
}
