// Adds corrections to the first guess, limited by the corrections smoothed along each axis, which filters out
// grid-scale oscillation. Equals flow::Advection.
layout(std430, binding = 1) restrict writeonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict writeonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 3) restrict readonly buffer GuessMoving { vec4 guessMoving[]; };
layout(std430, binding = 4) restrict readonly buffer GuessCarried { vec2 guessCarried[]; };
layout(std430, binding = 6) restrict readonly buffer MovingCorrections { vec4 movingCorrections[]; };
layout(std430, binding = 7) restrict readonly buffer CarriedCorrections { vec2 carriedCorrections[]; };

// Velocity, density, temperature, reaction.
struct Correction {
    vec4 moving;
    vec2 carried;
};

// Outside the box, corrections are those of the nearest cell, except that faces on the far sides, which do not move,
// have none.
Correction correctionAt(ivec3 c) {
    int cell = at(clamp(c, ivec3(0), cells - 1));
    vec3 within = vec3(lessThan(c, cells));
    return Correction(movingCorrections[cell] * vec4(within, 1), carriedCorrections[cell]);
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    Correction own = correctionAt(c), least = own, most = own;
    for (int axis = 0; axis < 3; ++axis) {
        Correction before = correctionAt(c - unit(axis)), behind = correctionAt(c + unit(axis));
        vec4 movingEvened = 0.25 * vec4(vec3(KEPT_OF_SPEEDS), KEPT_OF_CENTRES) * (before.moving + 2.0 * own.moving + behind.moving);
        vec2 carriedEvened = 0.25 * KEPT_OF_CENTRES * (before.carried + 2.0 * own.carried + behind.carried);
        least = Correction(min(least.moving, movingEvened), min(least.carried, carriedEvened));
        most = Correction(max(most.moving, movingEvened), max(most.carried, carriedEvened));
    }
    int cell = at(c);
    moving[cell] = guessMoving[cell] + max(least.moving, 0.0) + min(most.moving, 0.0);
    carried[cell] = guessCarried[cell] + max(least.carried, 0.0) + min(most.carried, 0.0);
}
