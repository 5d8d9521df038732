// One explicit step of the velocity's diffusion; `diffusion` is the viscosity times step over spacing squared.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 3) restrict writeonly buffer MovingThen { vec4 movingThen[]; };
uniform float diffusion;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!insideOrFar(c)) return;
    int cell = at(c);
    vec4 own = moving[cell];
    if (isFluid(cell)) {
        vec3 around = -6.0 * own.xyz;
        for (int axis = 0; axis < 3; ++axis)
            around += moving[cell + stepAlong(axis)].xyz + moving[cell - stepAlong(axis)].xyz;
        for (int axis = 0; axis < 3; ++axis)
            if (moves(cell, axis)) own[axis] += diffusion * around[axis];
    }
    movingThen[cell] = own;
}
