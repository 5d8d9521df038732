// Sets the coarse right-hand side to the residuals of the red cells, summed over each coarse cell. After a sweep the
// residuals of black cells vanish.
layout(std430, binding = 5) restrict writeonly buffer CoarseRightSide { float coarseRightSide[]; };
uniform ivec3 coarse;

void main() {
    ivec3 to = ivec3(gl_GlobalInvocationID);
    float sum = 0.0, maximum = 0.0;
    bool exists = all(lessThan(to, coarse));
    if (exists) {
        for (int n = 0; n < 4; ++n) {
            ivec3 c = 2 * to + ivec3(0, n & 1, n >> 1);
            c.x += c.x + c.y + c.z & 1;
            if (!inside(c)) continue;
            float r = residual(c);
            sum += r;
            // Not max(), which may ignore NaN.
            maximum = abs(r) <= maximum ? maximum : abs(r);
        }
        coarseRightSide[placeIn(to, coarse)] = sum;
    }
#ifdef FINEST
    tell(maximum);
#endif
}
