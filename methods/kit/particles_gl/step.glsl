// The numbers of a step (StepValues of step_values.h), the columns of the particles, and the tally of their number.
layout(local_size_x = 256) in;

layout(std140, binding = 0) uniform Step {
    uvec4 key;      // seed: low, high; serial of the first newborn: low, high
    uvec4 numbers;  // births, emitters, births that share a colour, forces
    uvec4 kinds;    // of position, velocity and size: the numbers in parts.glsl
    dvec2 births;   // moment of the first, spacing; s
    dvec2 seconds;  // of the step
    vec4 radius;    // at birth, change over life, or mean and deviation; z: seconds of the step
    vec4 opacity;   // coefficients of the curve
    vec4 life;      // mean lifetime, deviation; z: 1 if the opacity is held at 0; w: 1 if the colour follows a curve
    vec4 colours[2];  // w of the first: share of the second
    vec4 colourCurves[3];  // coefficients, for each channel
    vec4 source;    // extents: radius, or length and width, or length and share of its beginning
    vec4 launch;    // speed: own, share of the emitter's, deviation
    vec4 cone;      // depth, half angle in turns, 1 for the printed formula, share of the carrier's velocity
    vec4 coneFrame[3];  // of a fixed velocity: its direction, first
    vec4 from[4], to[4], velocityFrom[4], velocityTo[4], forward[4], up[4], right[4];  // of emitters; forward.w: speed
    vec4 sourceFirst[4], sourceSecond[4];  // directions of the extents
    vec4 ground;    // origin x and z, spacing of the heights
    ivec4 samples;  // columns, rows
    vec4 forces[64];  // four for each force; x of the first: its kind
};

layout(std430, binding = 1) buffer Positions { float positions[]; };   // x y z
layout(std430, binding = 2) buffer Velocities { float velocities[]; };
layout(std430, binding = 3) buffer Lives { float lives[]; };           // age, lifetime
layout(std430, binding = 4) buffer Looks { float looks[]; };           // radius, opacity
layout(std430, binding = 5) buffer Serials { uint serials[]; };        // low, high
layout(std430, binding = 6) buffer Colours { float colours_[]; };      // red green blue; COLOURED
layout(std430, binding = 7) buffer Tally {
    uint count;          // particles
    uint groups[3];      // work groups of 256 for them
    uint burials;        // places of the dead that no newborn takes
    uint burialGroups[3];
    uint before;         // particles at the start of the step
};

vec3 vectorAt(uint i, bool velocity) {
    return velocity ? vec3(velocities[3u * i], velocities[3u * i + 1u], velocities[3u * i + 2u])
                    : vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]);
}
void setVectors(uint i, vec3 position, vec3 velocity) {
    for (uint axis = 0u; axis < 3u; ++axis) {
        positions[3u * i + axis] = position[axis];
        velocities[3u * i + axis] = velocity[axis];
    }
}
