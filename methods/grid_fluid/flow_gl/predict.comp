// The first guess: each quantity at the departure point of its path. Quantities that do not move are unchanged.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 3) restrict writeonly buffer GuessMoving { vec4 guessMoving[]; };
layout(std430, binding = 4) restrict writeonly buffer GuessCarried { vec2 guessCarried[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!insideOrFar(c)) return;
    int cell = at(c);
    vec4 value = moving[cell];
    vec2 rest = carried[cell];
    if (isFluid(cell)) {
        for (int axis = 0; axis < 3; ++axis)
            if (moves(cell, axis)) value[axis] = SAMPLED(moving, [axis], cornersAround(behind(c, axis)));
        Corners corners = cornersAround(behind(c, 3));
        value.w = SAMPLED(moving, .w, corners);
        rest = SAMPLED(carried, .xy, corners);
    }
    guessMoving[cell] = value;
    guessCarried[cell] = rest;
}
