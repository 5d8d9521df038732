// The maximum magnitudes of speeds, divergence, density and temperature, as bits, which order like the values.
layout(binding = 0) uniform sampler3D velocity;
layout(binding = 2) uniform sampler3D density;
layout(binding = 3) uniform sampler3D temperature;
layout(std430, binding = 0) restrict buffer Report { uint maximum[6]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    vec3 u = texelFetch(velocity, c, 0).xyz;
    float values[6] = float[6](u.x, u.y, u.z, isSolid(c) ? 0.0 : divergenceAt(velocity, c), texelFetch(density, c, 0).r,
                               texelFetch(temperature, c, 0).r);
    for (int n = 0; n < 6; ++n) {
        uint bits = floatBitsToUint(values[n]) & 0x7fffffffu;
        if (bits > maximum[n]) atomicMax(maximum[n], bits);
    }
}
