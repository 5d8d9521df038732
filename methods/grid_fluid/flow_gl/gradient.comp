// u -= h grad q in all fluid cells, as in flow::Projection: a cell changes by the mean of the changes of its faces.
layout(std430, binding = 2) restrict writeonly buffer MovingThen { vec4 movingThen[]; };
layout(std430, binding = 5) restrict readonly buffer Pressure { float pressure[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    vec4 record = moving[cell];
    if (isFluid(cell)) {
        Star star = starAround(c);
        float q = pressure[star.own];
        ivec2 beside[3] = ivec2[3](star.twin - star.before + ivec2(0, 1), star.twin + ivec2(-star.row, star.row),
                                   star.twin + ivec2(-star.slab, star.slab));
        for (int axis = 0; axis < 3; ++axis) {
            int next = stepAlong(axis);
            uint before = conductance(cell - next), behind = conductance(cell + next);
            float change = float(before) * (pressure[beside[axis].x] - q) +
                           float(behind) * (q - pressure[beside[axis].y]);
            if (before == 0u || behind == 0u)
                record[axis] = 0.5 * (faceSpeed(cell, -next, axis) + faceSpeed(cell, next, axis));
            record[axis] += 0.5 * change;
        }
    }
    movingThen[cell] = record;
}
