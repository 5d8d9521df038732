// Adds the interpolated coarse pressure, multiplied by `times` (flow/poisson_level.h), to the black cells. The red ones
// follow with the next sweep.
layout(std430, binding = 1) restrict buffer Pressure { float pressure[]; };
layout(std430, binding = 2) restrict readonly buffer Wide { float wide[]; };
#ifdef FINEST
layout(std430, binding = 3) restrict readonly buffer Diagonal { float diagonals[]; };
float diagonal(ivec3 c) { return diagonals[place(c)]; }
#else
layout(std430, binding = 3) restrict readonly buffer Faces { vec4 faces[]; };
float diagonal(ivec3 c) { return faces[place(c)].w; }
#endif
uniform ivec3 coarse;
uniform float times;

void main() {
    ivec3 c = cellOfColour(1);
    if (!inside(c) || diagonal(c) <= 0.0) return;
    ivec3 own = c / 2, neighbour = own + 2 * (c & 1) - 1;
    float sum = 0.0;
    for (int n = 0; n < 8; ++n) {
        bvec3 far = bvec3(n & 1, n & 2, n & 4);
        vec3 weights = mix(vec3(0.75), vec3(0.25), far);
        sum += weights.x * weights.y * weights.z * wide[atIn(mix(own, neighbour, far), coarse)];
    }
    pressure[place(c)] += times * sum;
}
