// The velocity half-way along the path of each cell, u(x - dt/2 u(x)), and the maximum length of a path along z in
// cells. Source: Stam1999, 2.2.
layout(std430, binding = 5) restrict readonly buffer Centres { vec4 centres[]; };
layout(std430, binding = 6) restrict writeonly buffer Halfway { vec4 halfway[]; };
layout(std430, binding = 7) restrict readonly buffer Report { uint maximum[]; };
uniform float cellsPerSpeed;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID) - 1;
    if (any(greaterThan(c, cells))) return;
    ivec3 inner = clamp(c, ivec3(0), cells - 1);
    vec3 middle = within(vec3(inner + 1) - 0.5 * cellsPerSpeed * centres[at(inner)].xyz);
    float reach = min(ceil(uintBitsToFloat(maximum[2]) * cellsPerSpeed), float(cells.z)) + 1.0;
    halfway[at(c)] = vec4(SAMPLED(centres, .xyz, cornersAround(middle)), reach);
#ifdef EXTRAPOLATED
    halfway[at(c) + paddedCells()] = centres[at(inner)];  // the corrections will overwrite them
#endif
}
