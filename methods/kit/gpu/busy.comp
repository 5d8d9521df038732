// A known load for the self-test of timer queries: arithmetic that the compiler cannot optimise away.
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Values { float values[]; };
uniform int rounds;

void main() {
    float x = values[gl_GlobalInvocationID.x];
    for (int i = 0; i < rounds; ++i) x = x * 1.0001 + 0.5 - floor(x);
    values[gl_GlobalInvocationID.x] = x;
}
