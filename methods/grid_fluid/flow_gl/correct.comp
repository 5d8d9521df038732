// The correction: half of the error of the first guess when it is advected back, limited; 0 where there is none.
// Source: Selle2008, Eq. 4 and 3.2. Departs: as flow::Advection does.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 3) restrict readonly buffer GuessMoving { vec4 guessMoving[]; };
layout(std430, binding = 4) restrict readonly buffer GuessCarried { vec2 guessCarried[]; };
layout(std430, binding = 6) restrict writeonly buffer MovingCorrections { vec4 movingCorrections[]; };
layout(std430, binding = 7) restrict writeonly buffer CarriedCorrections { vec2 carriedCorrections[]; };

const float tolerance = PATH_TOLERANCE;  // cells by which a path may leave, since speeds across a wall are rounding errors

// LIMIT as flow::Limit: 0 clamp, 1 revert, 2 none.
vec3 limited(vec3 value, vec3 first, vec3 low, vec3 high) {
#if LIMIT == 0
    return clamp(value, low, high);
#elif LIMIT == 1
    vec3 kept = vec3(greaterThanEqual(value, low)) * vec3(lessThanEqual(value, high));
    return mix(first, value, greaterThan(kept, vec3(0)));
#else
    return value;
#endif
}

// The velocity at a cell's centre, at the time whose velocity paths follow.
vec3 speedOf(ivec3 c) {
    int cell = at(max(c, ivec3(0)));
#ifdef EXTRAPOLATED
    return halfway[cell + paddedCells()].xyz;
#else
    return CENTRE_VELOCITY(moving, cell);
#endif
}

// Moves `place` to the end of its path, limited to the region of the first guess: between the outermost places that
// move, and no farther along z than the maximum speed. Returns whether the path stays within it.
bool follow(ivec3 c, int kind, vec3 velocity, inout vec3 place) {
    float reach = halfway[at(c)].w;
    vec3 low = vec3(1), high = vec3(cells);
    if (kind < 3) high[kind] += 1.0;
    low.z = max(low.z, float(c.z + 1) - reach);
    high.z = min(high.z, float(c.z + 1) + reach);
    vec3 ahead = place + 2.0 * cellsPerSpeed * velocity;
    bool stays = all(greaterThanEqual(min(ahead, place), low - tolerance)) && all(lessThanEqual(max(ahead, place), high + tolerance));
    place = clamp(ahead, low, high);
    return stays;
}

float faceCorrection(ivec3 c, int axis, vec3 velocity, float first) {
    vec3 began = behind(c, axis), ended = began;
    if (!follow(c, axis, velocity, ended)) return 0.0;
    float value = first + 0.5 * (moving[at(c)][axis] - SAMPLED(guessMoving, [axis], cornersAround(ended)));
    int low = cornersAround(began).low;
    float minimum = moving[low][axis], maximum = minimum;
    for (int n = 1; n < 8; ++n) {
        float there = moving[corner(low, n)][axis];
        minimum = min(minimum, there);
        maximum = max(maximum, there);
    }
    return limited(vec3(value), vec3(first), vec3(minimum), vec3(maximum)).x - first;
}

// Density, temperature and reaction.
vec3 centreCorrection(ivec3 c, vec3 velocity, vec3 first) {
    vec3 began = behind(c, 3), ended = began;
    if (!follow(c, 3, velocity, ended)) return vec3(0);
    Corners there = cornersAround(ended);
    vec3 own = vec3(moving[at(c)].w, carried[at(c)]);
    vec3 value = first + 0.5 * (own - vec3(SAMPLED(guessMoving, .w, there), SAMPLED(guessCarried, .xy, there)));
    int low = cornersAround(began).low;
    vec3 minimum = vec3(moving[low].w, carried[low]), maximum = minimum;
    for (int n = 1; n < 8; ++n) {
        int other = corner(low, n);
        vec3 value = vec3(moving[other].w, carried[other]);
        minimum = min(minimum, value);
        maximum = max(maximum, value);
    }
    return limited(value, first, minimum, maximum) - first;
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    vec3 faces = vec3(0), centre = vec3(0);
    if (isFluid(cell)) {
        vec3 own = speedOf(c);
        for (int axis = 0; axis < 3; ++axis)
            if (moves(cell, axis))
                faces[axis] = faceCorrection(c, axis, 0.5 * (own + speedOf(c - unit(axis))), guessMoving[cell][axis]);
        centre = centreCorrection(c, own, vec3(guessMoving[cell].w, guessCarried[cell]));
    }
    movingCorrections[cell] = vec4(faces, centre.x);
    carriedCorrections[cell] = centre.yz;
}
