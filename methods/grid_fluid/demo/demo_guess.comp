// The first guess: the value where a cell's path began. Source: Crane2007, 30.2.
layout(binding = 0) uniform sampler3D velocity;
layout(binding = 1) uniform sampler3D field;
layout(binding = 0, FORMAT) restrict writeonly uniform image3D guess;
uniform float cellsPerSpeed;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    imageStore(guess, c, sampled(field, within(vec3(c) - cellsPerSpeed * texelFetch(velocity, c, 0).xyz)));
}
