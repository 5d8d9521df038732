// Every invocation draws a ticket and signs it: with working atomics all tickets are given once.
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Counter { uint next; };
layout(std430, binding = 1) writeonly buffer Tickets { uint owner[]; };

void main() {
    const uint ticket = atomicAdd(next, 1u);
    if (ticket < gl_NumWorkGroups.x * 64u) owner[ticket] = gl_GlobalInvocationID.x;
}
