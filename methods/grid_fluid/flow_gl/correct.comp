// Adds half of the error of the first guess when it is advected back, within limits.
// Source: Selle2008, Eq. 4 and 3.2. Departs: as flow::Advection does.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 3) restrict readonly buffer GuessMoving { vec4 guessMoving[]; };
layout(std430, binding = 4) restrict readonly buffer GuessCarried { vec2 guessCarried[]; };
layout(std430, binding = 5) restrict buffer MovingThen { vec4 movingThen[]; };  // initially the departure points
layout(std430, binding = 6) restrict writeonly buffer CarriedThen { vec2 carriedThen[]; };
layout(std430, binding = 7) restrict readonly buffer Report { uint maximum[]; };
uniform float cellsPerSpeed;

// The eight surrounding cells in sequence.
int corner(int low, int n) {
    return low + (n & 1) + (n >> 1 & 1) * stepAlong(1) + (n >> 2) * stepAlong(2);
}

// LIMIT as flow::Limit: 0 clamp, 1 revert, 2 none.
vec4 limited(vec4 value, vec4 first, vec4 low, vec4 high) {
#if LIMIT == 0
    return clamp(value, low, high);
#else
    vec4 kept = vec4(greaterThanEqual(value, low)) * vec4(lessThanEqual(value, high));
    return mix(first, value, greaterThan(kept, vec4(0)));
#endif
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    vec4 movingFirst = guessMoving[cell];
    vec2 carriedFirst = guessCarried[cell];
    vec3 behind = movingThen[cell].xyz;
    vec4 own = moving[cell];
    vec3 ahead = behind + 2.0 * cellsPerSpeed * own.xyz;
    // The first guess has no value beyond the outermost centres, and is not used farther along z than the maximum speed.
    float reach = min(ceil(uintBitsToFloat(maximum[2]) * cellsPerSpeed), float(cells.z)) + 1.0;
    vec3 low = vec3(1, 1, max(1.0, float(c.z + 1) - reach));
    vec3 high = vec3(cells.xy, min(float(cells.z), float(c.z + 1) + reach));
    bool corrected = isFluid(cell) && all(greaterThanEqual(min(ahead, behind), low)) &&
                     all(lessThanEqual(max(ahead, behind), high));
    vec4 movingValue = movingFirst;
    vec2 carriedValue = carriedFirst;
    if (corrected) {
        Corners there = cornersAround(ahead);
        movingValue += 0.5 * (own - SAMPLED(guessMoving, there));
        carriedValue += 0.5 * (carried[cell] - SAMPLED(guessCarried, there));
#if LIMIT != 2
        int from = cornersAround(behind).low;
        vec4 movingMinimum = moving[from], movingMaximum = movingMinimum;
        vec2 carriedMinimum = carried[from], carriedMaximum = carriedMinimum;
        for (int n = 1; n < 8; ++n) {
            vec4 m = moving[corner(from, n)];
            vec2 t = carried[corner(from, n)];
            movingMinimum = min(movingMinimum, m);
            movingMaximum = max(movingMaximum, m);
            carriedMinimum = min(carriedMinimum, t);
            carriedMaximum = max(carriedMaximum, t);
        }
        movingValue = limited(movingValue, movingFirst, movingMinimum, movingMaximum);
        carriedValue = limited(vec4(carriedValue, 0, 0), vec4(carriedFirst, 0, 0), vec4(carriedMinimum, 0, 0),
                               vec4(carriedMaximum, 0, 0)).xy;
#endif
    }
    movingThen[cell] = movingValue;
    carriedThen[cell] = carriedValue;
}
