// Two vertices per particle, pulled from the instance buffer: the current position and an earlier one.
layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z velocity opacity red green blue
};
uniform int count;
uniform vec3 eye;
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance
uniform float seconds;
#ifdef FADE
out vec4 lineColour;
#else
flat out vec4 lineColour;
#endif

void main() {
    int base = min(gl_VertexID >> 1, count - 1) * FLOATS;
    vec3 velocity = vec3(values[base + 3], values[base + 4], values[base + 5]);
    float back = (gl_VertexID & 1) != 0 ? seconds : 0.0;
    vec3 place = vec3(values[base], values[base + 1], values[base + 2]) - back * velocity;
    vec3 position = mat3(worldToEye) * (place - eye);
    gl_Position = vec4(position.xy * projection.xy, projection.z, -position.z);
    lineColour = vec4(values[base + 7], values[base + 8], values[base + 9], values[base + 6]);
#ifdef FADE
    if ((gl_VertexID & 1) != 0) lineColour.a = 0.0;
#endif
}
