// A triangle that covers the target, once per instance, in the instance's colour.
layout(location = 0) in vec4 instanceColour;
flat out vec4 colour;

void main() {
    colour = instanceColour;
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0);
}
