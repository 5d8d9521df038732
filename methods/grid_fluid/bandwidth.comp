// Reads a value from each of STREAMS arrays, performs OPERATIONS multiply-adds on each component, and writes a value to
// each of STREAMS arrays.
layout(local_size_x = 256) in;
layout(std430, binding = 0) restrict readonly buffer First { vec4 first[]; };
layout(std430, binding = 1) restrict writeonly buffer FirstResult { vec4 firstResult[]; };
#if STREAMS == 2
layout(std430, binding = 2) restrict readonly buffer Second { vec4 second[]; };
layout(std430, binding = 3) restrict writeonly buffer SecondResult { vec4 secondResult[]; };
#endif
uniform vec4 factor;

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 value = first[i];
    for (int operation = 0; operation < OPERATIONS; ++operation) value = value * factor + factor;
    firstResult[i] = value;
#if STREAMS == 2
    secondResult[i] = second[i];
#endif
}
