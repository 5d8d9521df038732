// One sweep of Jacobi. Source: Crane2007, 30.2.
layout(binding = 0) uniform sampler3D pressure;
layout(binding = 1) uniform sampler3D divergence;
layout(binding = 0, r16f) restrict writeonly uniform image3D result;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    float sum = 0.0;
    for (int n = 0; n < 6; ++n) sum += neighbourPressure(pressure, c, n >> 1, n & 1);
    imageStore(result, c, vec4((sum - texelFetch(divergence, c, 0).r) / 6.0));
}
