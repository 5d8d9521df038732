// The velocity at each cell's centre that paths follow: that of the state, or with EXTRAPOLATED that at the middle of
// the step (flow::CentreVelocities). Beyond the box it is that of the outermost cells.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 5) restrict writeonly buffer Centres { vec4 centres[]; };
#ifdef EXTRAPOLATED
layout(std430, binding = 2) restrict readonly buffer Last { vec4 last[]; };
layout(std430, binding = 7) restrict readonly buffer Report { uint maximum[]; };
uniform float ahead;  // half of this step, divided by the last step
#endif

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID) - 1;
    if (any(greaterThan(c, cells))) return;
    int cell = at(clamp(c, ivec3(0), cells - 1));
    vec3 velocity = CENTRE_VELOCITY(moving, cell);
#ifdef EXTRAPOLATED
    vec3 most = uintBitsToFloat(uvec3(maximum[0], maximum[1], maximum[2]));
    velocity = clamp(velocity + ahead * (velocity - last[cell].xyz), -most, most);
#endif
    centres[at(c)] = vec4(velocity, 0);
}
