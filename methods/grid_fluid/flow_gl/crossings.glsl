// Crossings of a mesh by the rays along one axis through the centres of all cells, as in MeshCells: with the same
// arithmetic, in double precision and without contraction, so that the cells are the same.
//
// Rays are numbered by the two axes that follow theirs, in cyclic order: j + size.y * k.
layout(local_size_x = 64) in;

struct Crossing {
    float x;
    int inwards;  // 1 entering, -1 leaving
    uint triangle;
    int depth;  // nesting depth behind the crossing, counted from the left
    float normal[3];
    float unused;
};
uniform int axis;
uniform ivec3 size;  // of the grid, the rays' axis first
uniform int count;   // of threads

int threadNumber() {
    return int(gl_GlobalInvocationID.x + gl_NumWorkGroups.x * 64u * gl_WorkGroupID.y);
}
