// The departure points of a cell's paths: those of its faces across x, y and z (0 to 2), and of its centre (3).
// Velocities half-way along the paths of all cells, then, with EXTRAPOLATED, those at all centres at the middle of the
// step.
layout(std430, binding = 5) restrict readonly buffer Halfway { vec4 halfway[]; };
uniform float cellsPerSpeed;

// x - dt u; a face has the mean velocity of its two cells.
vec3 behind(ivec3 c, int place) {
    vec3 u = halfway[at(c)].xyz;
    if (place < 3) u = 0.5 * (u + halfway[at(c - unit(place))].xyz);
    return within(vec3(c + 1) - cellsPerSpeed * u);
}
