// The curl of the velocity times the spacing, by central differences, and its magnitude.
layout(binding = 0) uniform sampler3D velocity;
layout(binding = 0, rgba16f) restrict writeonly uniform image3D curl;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    vec3 w = vec3(0);
    if (!isSolid(c)) {
        vec3 x = neighbourVelocity(velocity, c, 0, 1) - neighbourVelocity(velocity, c, 0, 0);
        vec3 y = neighbourVelocity(velocity, c, 1, 1) - neighbourVelocity(velocity, c, 1, 0);
        vec3 z = neighbourVelocity(velocity, c, 2, 1) - neighbourVelocity(velocity, c, 2, 0);
        w = 0.5 * vec3(y.z - z.y, z.x - x.z, x.y - y.x);
    }
    imageStore(curl, c, vec4(w, length(w)));
}
