// The first guess: samples the departure point of each cell, x - dt u(x - dt/2 u(x)).
// Source: Stam1999, 2.2.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 3) restrict writeonly buffer GuessMoving { vec4 guessMoving[]; };
layout(std430, binding = 4) restrict writeonly buffer GuessCarried { vec2 guessCarried[]; };
#ifdef CORRECTED
layout(std430, binding = 5) restrict writeonly buffer Places { vec4 places[]; };  // for the correction
#endif
uniform float cellsPerSpeed;

vec3 within(vec3 place) {
    return clamp(place, vec3(0), vec3(cells + 1));
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    vec3 here = vec3(c + 1);
    vec3 middle = within(here - 0.5 * cellsPerSpeed * moving[cell].xyz);
    Corners halfway = cornersAround(middle);
    vec3 behind = within(here - cellsPerSpeed * SAMPLED(moving, halfway).xyz);
    Corners corners = cornersAround(behind);
    bool fluid = isFluid(cell);
    guessMoving[cell] = fluid ? SAMPLED(moving, corners) : moving[cell];
    guessCarried[cell] = fluid ? SAMPLED(carried, corners) : carried[cell];
#ifdef CORRECTED
    places[cell] = vec4(behind, 0);
#endif
}
