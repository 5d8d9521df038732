// The strength at each source's centre for which all cells together receive its amount; one thread group per source.
layout(std430, binding = 4) restrict writeonly buffer Added { float added[]; };
uniform int count;

shared float parts[GROUP];

void main() {
    int s = min(groupNumber(), count - 1), own = int(gl_LocalInvocationIndex);
    ivec3 first = sources[s].first.xyz, size = sources[s].last.xyz - first + 1;
    int reached = sources[s].middle.w != 0 ? size.x * size.y * size.z : 0;
    float sum = 0.0;
    for (int n = own; n < reached; n += GROUP) {
        ivec3 c = first + ivec3(n % size.x, n / size.x % size.y, n / size.x / size.y);
        if (isFluid(at(c))) sum += strengthAt(vec3(c), s);
    }
    parts[own] = sum;
    for (int width = GROUP / 2; width > 0; width /= 2) {
        barrier();
        if (own < width) parts[own] += parts[own + width];
    }
    if (own == 0) added[s] = sources[s].density + (parts[0] > 0.0 ? sources[s].amount / parts[0] : 0.0);
}
