// Scales all densities to the expected total.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 3) restrict readonly buffer Balance {
    double covered, due;
    float scale;
};

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (inside(c)) moving[at(c)].w *= scale;
}
