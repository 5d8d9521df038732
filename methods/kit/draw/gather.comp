// Writes the puffs of GPU dust as instances, in a given order, and the arguments of their draw call.
layout(local_size_x = 256) in;
layout(std430, binding = 0) restrict writeonly buffer Instances {
    float values[];  // x y z radius opacity [red green blue]
};
layout(std430, binding = 1) restrict readonly buffer Positions { float positions[]; };
layout(std430, binding = 2) restrict readonly buffer Looks { float looks[]; };
layout(std430, binding = 3) restrict readonly buffer Colours { float colours[]; };
layout(std430, binding = 4) restrict readonly buffer Order { uint order[]; };
layout(std430, binding = 5) restrict readonly buffer Tally { uint puffs; };
layout(std430, binding = 6) restrict writeonly buffer Drawn {
    uint count;         // read by the vertex shader
    uint arguments[5];  // of an indexed draw: indices, instances, first index, base vertex, base instance
};
uniform bool ordered;

void main() {
    uint place = gl_GlobalInvocationID.x;
    if (place == 0u) {
        count = puffs;
        arguments = uint[5](INDICES, (puffs + SHAPES_AT_ONCE - 1u) / SHAPES_AT_ONCE, 0u, 0u, 0u);
    }
    if (place >= puffs) return;
    uint i = ordered ? order[place] : place, value = FLOATS * place;
    for (uint axis = 0u; axis < 3u; ++axis) values[value + axis] = positions[3u * i + axis];
    values[value + 3u] = looks[2u * i];
    values[value + 4u] = looks[2u * i + 1u];
#ifdef COLOURED
    for (uint channel = 0u; channel < 3u; ++channel) values[value + 5u + channel] = colours[3u * i + channel];
#endif
}
