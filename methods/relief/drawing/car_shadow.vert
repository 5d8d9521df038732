// The car as seen from the sun: depth only.
layout(location = 0) in vec3 position;
uniform mat4 toLight;
void main() {
    gl_Position = toLight * vec4(position, 1.0);
}
