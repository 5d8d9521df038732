// Marks the living among the last particles, which will move to the places of the dead that no newborn has taken.
layout(std430, binding = 9) readonly buffer Dead { uint dead[]; };
layout(std430, binding = 10) readonly buffer Holes { uint holes[]; };
layout(std430, binding = 11) writeonly buffer Tail { uint tail[]; };
layout(std430, binding = 12) writeonly buffer Living { uint living[]; };

void main() {
    uint j = gl_GlobalInvocationID.x;
    if (j >= burials) return;
    uint i = count + j;
    tail[j] = i;
    living[j] = dead[i] == 0u || i < holes[numbers.x] ? 1u : 0u;  // newborns took the first places
}
