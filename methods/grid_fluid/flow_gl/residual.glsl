// The residual of a cell, and the maximum magnitude as bits, which order like the values.
layout(std430, binding = 4) restrict readonly buffer RightSide { float rightSide[]; };

float residual(ivec3 c) {
    Star star = starAround(c);
    float weight = diagonal(star);
    return weight > 0.0 ? rightSide[star.own] - (neighbours(star) - weight * pressure[star.own]) : 0.0;
}

#ifdef FINEST
layout(std430, binding = 7) restrict buffer Report { uint report[]; };
uniform int slot;

shared uint maximum;

// Call from all threads of a group.
void tell(float magnitude) {
    if (gl_LocalInvocationIndex == 0u) maximum = 0u;
    barrier();
    atomicMax(maximum, floatBitsToUint(magnitude) & 0x7fffffffu);
    barrier();
    if (gl_LocalInvocationIndex == 0u) atomicMax(report[slot], maximum);
}
#endif
