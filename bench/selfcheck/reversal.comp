// Reverses each group through shared memory and moves it to another group: needs both kinds of barrier.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer From { uint from[]; };
layout(std430, binding = 1) writeonly buffer To { uint to[]; };
shared uint held[64];

void main() {
    held[gl_LocalInvocationID.x] = from[gl_GlobalInvocationID.x];
    barrier();
    const uint group = (gl_WorkGroupID.x * 5u + 3u) % gl_NumWorkGroups.x;
    to[group * 64u + gl_LocalInvocationID.x] = held[63u - gl_LocalInvocationID.x] + 1u;
}
