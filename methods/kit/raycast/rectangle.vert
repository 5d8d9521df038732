// Covers a rectangle of pixels.
uniform vec4 rectangle;  // left bottom right top, each −1..1

void main() {
    gl_Position = vec4((gl_VertexID & 1) == 0 ? rectangle.x : rectangle.z, gl_VertexID < 2 ? rectangle.y : rectangle.w,
                       0, 1);
}
