// A coarse face conducts the sum of its finer faces, over a longer distance; see flow::PoissonLevel::buildFrom.
#ifndef FINEST
layout(std430, binding = 1) restrict readonly buffer Finer { vec4 finer[]; };
#endif
layout(std430, binding = 3) restrict writeonly buffer Faces { vec4 faces[]; };
uniform ivec3 fine;  // the finer level's cells

// Weight of the face from a finer cell to the next along an axis.
float fineFace(ivec3 c, int axis) {
#ifdef FINEST
    ivec3 next = c;
    next[axis] += 1;
    return float(conductance(atIn(c, fine)) * conductance(atIn(next, fine)));
#else
    return finer[placeIn(c, fine)][axis];
#endif
}

// Factor on the conductance for the distance across the face behind coarse cell c.
float share(int c, int fineCells) {
    int last = (fineCells + 1) / 2 - 1;
    if (fineCells == 1) return 1.0;
    if (fineCells % 2 == 0 || c < last - 1) return 0.5;
    return c == last ? 1.0 : 2.0 / 3.0;
}

float face(ivec3 c, int axis) {
    int b = (axis + 1) % 3, d = (axis + 2) % 3;
    ivec3 f = 2 * c;
    f[axis] = min(2 * c[axis] + 1, fine[axis] - 1);  // the last of a coarse cell's; -1 before the first
    float sum = 0.0;
    for (int n = 0; n < 4; ++n) {
        ivec3 one = f;
        one[b] += n & 1;
        one[d] += n >> 1;
        if (one[b] < fine[b] && one[d] < fine[d]) sum += fineFace(one, axis);
    }
    return share(c[axis], fine[axis]) * sum;
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID) - 1;
    if (any(greaterThanEqual(c, cells))) return;
    vec4 own = vec4(0);
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 before = c;
        before[axis] -= 1;
        // Ghosts have only the face towards the box.
        ivec3 across = c;
        across[axis] = 0;
        if (all(greaterThanEqual(across, ivec3(0)))) own[axis] = face(c, axis);
        if (inside(c)) own.w += own[axis] + face(before, axis);
    }
    faces[place(c)] = own;
}
