// A solid as the sun sees it: depth alone.
layout(location = 0) in vec3 position;
uniform mat4 toLight;
void main() {
    gl_Position = toLight * vec4(position, 1.0);
}
