// Curl of the velocity in 1/s, by central differences of the speeds at the centres, each the mean of two faces; and its magnitude.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 5) restrict writeonly buffer Curl { vec4 curl[]; };
uniform float spacing;

// Four times the difference of a speed over a cell's width.
float along(int cell, int step, int lane) {
    int face = stepAlong(lane);  // to the cell's other face
    return (moving[cell + step][lane] + moving[cell + face + step][lane]) -
           (moving[cell - step][lane] + moving[cell + face - step][lane]);
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c), row = stepAlong(1), slab = stepAlong(2);
    float perFourCells = isFluid(cell) ? 0.25 / spacing : 0.0;
    vec3 w = vec3(along(cell, row, 2) - along(cell, slab, 1), along(cell, slab, 0) - along(cell, 1, 2),
                  along(cell, 1, 1) - along(cell, row, 0)) * perFourCells;
    curl[cell] = vec4(w, length(w));
}
