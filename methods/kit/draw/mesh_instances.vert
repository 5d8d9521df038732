// A mesh in place of each particle: scaled, and optionally turned along its velocity.
layout(location = 0) in vec3 position;  // the mesh's frame
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;

layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z radius opacity velocity (3) red green blue
};
uniform vec3 eye;
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance
uniform vec4 middle;      // of the mesh, and 1 / its radius

out vec3 outwards;   // world
out vec3 fromEye;    // world
out vec3 diffuse;
flat out float opacity;

const int floats = 11;

void main() {
    int base = gl_InstanceID * floats;
    vec3 offset = (position - middle.xyz) * (middle.w * values[base + 3]);
    vec3 away = normal;
#ifdef ALONG_VELOCITY
    // The mesh's x axis along the velocity, its z axis horizontal.
    vec3 velocity = vec3(values[base + 5], values[base + 6], values[base + 7]);
    float speed = length(velocity);
    vec3 forward = speed > 1e-6 ? velocity / speed : vec3(1, 0, 0);
    vec3 side = vec3(-forward.z, 0, forward.x);
    float level = length(side);
    side = level > 1e-6 ? side / level : vec3(0, 0, 1);
    mat3 turn = mat3(forward, cross(side, forward), side);
    offset = turn * offset;
    away = turn * away;
#endif
    fromEye = vec3(values[base], values[base + 1], values[base + 2]) - eye + offset;
    outwards = away;
    diffuse = albedo * vec3(values[base + 8], values[base + 9], values[base + 10]);
    opacity = values[base + 4];
    vec3 seen = mat3(worldToEye) * fromEye;
    gl_Position = vec4(seen.xy * projection.xy, projection.z, -seen.z);
}
