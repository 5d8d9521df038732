// Subtracts the gradient of the pressure; next to a solid the air takes the solid's speed. Source: Crane2007, 30.2.
layout(binding = 0) uniform sampler3D velocity;
layout(binding = 1) uniform sampler3D pressure;
layout(binding = 0, rgba16f) restrict writeonly uniform image3D result;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    vec4 u = texelFetch(velocity, c, 0);
    if (!isSolid(c))
        for (int axis = 0; axis < 3; ++axis) {
            u[axis] -= 0.5 * (neighbourPressure(pressure, c, axis, 1) - neighbourPressure(pressure, c, axis, 0));
            for (int side = 0; side < 2; ++side) {
                ivec3 other = c + (2 * side - 1) * unit(axis);
                if (inside(other) ? isSolid(other) : sides[2 * axis + side] == 1) u[axis] = neighbourVelocity(velocity, c, axis, side)[axis];
            }
        }
    imageStore(result, c, u);
}
