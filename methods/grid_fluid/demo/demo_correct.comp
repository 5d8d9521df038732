// Adds half of the error of the guess along the path ahead, clamped to the eight nodes around the path's beginning.
// Source: Crane2007, 30.2; Selle2008, Eq. 4.
layout(binding = 0) uniform sampler3D velocity;
layout(binding = 1) uniform sampler3D field;
layout(binding = 2) uniform sampler3D guess;
layout(binding = 0, FORMAT) restrict writeonly uniform image3D result;
uniform float cellsPerSpeed, kept;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    if (isSolid(c)) {
        imageStore(result, c, SOLID);
        return;
    }
    vec3 way = cellsPerSpeed * texelFetch(velocity, c, 0).xyz;
    vec4 value = texelFetch(guess, c, 0) + 0.5 * (texelFetch(field, c, 0) - sampled(guess, within(vec3(c) + way)));
    ivec3 low = ivec3(floor(within(vec3(c) - way)));
    vec4 minimum = at(field, low), maximum = minimum;
    for (int n = 1; n < 8; ++n) {
        vec4 node = at(field, low + ivec3(n & 1, n >> 1 & 1, n >> 2));
        minimum = min(minimum, node);
        maximum = max(maximum, node);
    }
    imageStore(result, c, kept * clamp(value, minimum, maximum));
}
