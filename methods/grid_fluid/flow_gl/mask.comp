// Sets the kind of each cell from the numbers of the solids.
layout(std430, binding = 0) restrict writeonly buffer Kinds { uint kinds[]; };
layout(std430, binding = 1) restrict readonly buffer Bodies { uint bodies[]; };  // a byte for each cell, no ghosts
uniform int anySolid;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    uint body = 0u;
    if (anySolid != 0) {
        int n = c.x + cells.x * (c.y + cells.y * c.z);
        body = bodies[n >> 2] >> (8 * (n & 3)) & 255u;
    }
    kinds[at(c)] = body == 0u ? 1u : body << 2;
}
