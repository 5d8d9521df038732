// The maximum residual over all cells.
void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    tell(inside(c) ? residual(c) : 0.0);
}
