// One face of a cube, in a single premultiplied colour.
flat in vec4 face;
layout(location = 0) out vec4 colour;

void main() {
    colour = face;
}
