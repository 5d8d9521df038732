// |p − e|² of puffs, with the operations of DepthSort: equal puffs get equal depths there and here.
layout(local_size_x = 256) in;
layout(std430, binding = 0) restrict readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) restrict readonly buffer Tally { uint puffs; };
layout(std430, binding = 2) restrict writeonly buffer Depths { float depths[]; };
uniform vec3 eye;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= puffs) return;
    precise vec3 d = vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]) - eye;
    precise float squared = d.x * d.x + d.y * d.y + d.z * d.z;
    depths[i] = squared;
}
