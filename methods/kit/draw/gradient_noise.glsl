// Noise that a puff carries along; puff_noise.h has the formula, puff_noise.cpp the reference.
uint latticeHash(ivec3 cell) {
    uvec3 c = uvec3(cell);
    uint h = c.x * 0x8da6b343u ^ c.y * 0xd8163841u ^ c.z * 0xcb1ab31fu;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

/// The scalar product of one of the twelve vectors to the middles of a cube's edges with `d`.
float alongEdge(uint hash, vec3 d) {
    uint edge = hash % 12u;
    float u = edge < 8u ? d.x : d.y, v = edge < 4u ? d.y : d.z;
    return ((edge & 1u) != 0u ? -u : u) + ((edge & 2u) != 0u ? -v : v);
}

float gradientNoise(vec3 q) {
    vec3 below = floor(q), f = q - below;
    ivec3 cell = ivec3(below);
    vec3 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    float sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 at = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        vec3 share = mix(1.0 - w, w, vec3(at));
        sum += share.x * share.y * share.z * alongEdge(latticeHash(cell + at), f - vec3(at));
    }
    return sum;
}

/// g(N(q)), −1..1.
float puffNoise(vec3 q) {
    float sum = 4.0 * gradientNoise(q) + 2.0 * gradientNoise(2.0 * q + 17.3) + gradientNoise(4.0 * q + 41.7);
    return clamp(2.2 / 7.0 * sum, -1.0, 1.0);
}
