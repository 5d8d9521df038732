// Assigns each ray a range for its crossings, one thread per ray, and resets their number to 0.
layout(std430, binding = 2) restrict buffer Counts { uint counts[]; };
layout(std430, binding = 3) restrict writeonly buffer Firsts { uint firsts[]; };
layout(std430, binding = 5) restrict buffer Total { uint total; };

void main() {
    int ray = threadNumber();
    if (ray >= count) return;
    firsts[ray] = atomicAdd(total, counts[ray]);
    counts[ray] = 0u;
}
