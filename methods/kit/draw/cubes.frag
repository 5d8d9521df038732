// One face of a cube, of the same premultiplied colour all over.
flat in vec4 face;
layout(location = 0) out vec4 colour;

void main() {
    colour = face;
}
