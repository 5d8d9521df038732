// Fills the cells of a ray that are inside the mesh, and those of thin walls, as MeshCells does; one thread per ray.
layout(std430, binding = 2) restrict readonly buffer Counts { uint counts[]; };
layout(std430, binding = 3) restrict readonly buffer Firsts { uint firsts[]; };
layout(std430, binding = 4) restrict buffer Crossings { Crossing crossings[]; };
layout(std430, binding = 6) restrict writeonly buffer Bodies { uint bodies[]; };  // of each cell, no ghosts
uniform int body;

ivec3 cellAt(int i, int ray) {
    ivec3 cell;
    cell[axis] = i;
    cell[(axis + 1) % 3] = ray % size.y;
    cell[(axis + 2) % 3] = ray / size.y;
    return cell;
}

void fill(int i, int ray) {
    ivec3 all;  // the grid's own order
    all[axis] = size.x;
    all[(axis + 1) % 3] = size.y;
    all[(axis + 2) % 3] = size.z;
    ivec3 cell = cellAt(i, ray);
    bodies[cell.x + all.x * (cell.y + all.y * cell.z)] = uint(body);
}

bool comesBefore(Crossing one, Crossing other) {
    if (one.x != other.x) return one.x < other.x;
    if (one.inwards != other.inwards) return one.inwards < other.inwards;
    return one.triangle < other.triangle;
}

void sort(int first, int end) {
    for (int n = first + 1; n < end; ++n) {
        Crossing moved = crossings[n];
        int to = n;
        for (; to > first && comesBefore(moved, crossings[to - 1]); --to) crossings[to] = crossings[to - 1];
        crossings[to] = moved;
    }
}

int firstBeyond(float x) {
    return int(clamp(ceil(x - 0.5), 0.0, float(size.x)));
}

void fillInside(int first, int end, int ray) {
    int depth = 0;
    for (int n = first; n < end; ++n) crossings[n].depth = depth = max(0, depth + crossings[n].inwards);
    depth = 0;
    for (int n = end - 1; n > first; --n) {
        depth = max(0, depth - crossings[n].inwards);
        if (depth == 0 || crossings[n - 1].depth == 0) continue;
        for (int i = firstBeyond(crossings[n - 1].x); i < firstBeyond(crossings[n].x); ++i) fill(i, ray);
    }
}

void fillThinWalls(int first, int end, int ray) {
    for (int n = first + 1; n < end; ++n) {
        Crossing entered = crossings[n - 1], left = crossings[n];
        precise float cosine = entered.normal[0] * left.normal[0] + entered.normal[1] * left.normal[1] +
                               entered.normal[2] * left.normal[2];
        if (entered.inwards != 1 || left.inwards != -1 || cosine > -0.5) continue;  // 120 degrees
        precise float thickness = left.x - entered.x;
        if (thickness >= 1.0) continue;
        int i = int(floor(0.5 * (entered.x + left.x)));
        if (i >= 0 && i < size.x) fill(i, ray);
    }
}

void main() {
    int ray = threadNumber();
    if (ray >= count) return;
    int first = int(firsts[ray]), end = first + int(counts[ray]);
    sort(first, end);
    if (axis == 0) fillInside(first, end, ray);
    fillThinWalls(first, end, ray);
}
