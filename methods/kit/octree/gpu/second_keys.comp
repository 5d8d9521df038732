// The high words of the places, in the order of the low ones; not needed in trees of few levels.
layout(local_size_x = 256) in;
layout(std430, binding = 1) restrict readonly buffer Places { uvec2 places[]; };
layout(std430, binding = 2) restrict readonly buffer Indices { uint indices[]; };
layout(std430, binding = 3) restrict writeonly buffer Keys { uint keys[]; };

void main() {
    uint k = gl_GlobalInvocationID.x;
    if (k < state.counts.w) keys[k] = places[indices[k]].y;
}
