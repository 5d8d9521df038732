layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer From { vec4 from[]; };
layout(std430, binding = 1) writeonly buffer To { vec4 to[]; };

void main() {
    to[gl_GlobalInvocationID.x] = from[gl_GlobalInvocationID.x];
}
