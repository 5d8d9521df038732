// The grid of the demo with one thread per cell, and its fields: textures without ghost cells.
layout(local_size_x = 32, local_size_y = 4, local_size_z = 1) in;
uniform ivec3 cells;
layout(binding = 6) uniform sampler3D solidVelocity;
layout(binding = 7) uniform sampler3D solids;

// The sides in the order -x, +x, -y, +y, -z, +z: 0 open, 1 wall, 2 inflow.
const int sides[6] = SIDES;

bool inside(ivec3 c) {
    return all(greaterThanEqual(c, ivec3(0))) && all(lessThan(c, cells));
}

bool isSolid(ivec3 c) {
    return texelFetch(solids, c, 0).r > 0.5;
}

ivec3 unit(int axis) {
    return ivec3(axis == 0, axis == 1, axis == 2);
}

vec4 at(sampler3D field, ivec3 c) {
    return texelFetch(field, clamp(c, ivec3(0), cells - 1), 0);
}

// `place` in cells from the centre of the first cell.
vec4 sampled(sampler3D field, vec3 place) {
    ivec3 low = ivec3(floor(place));
    vec3 f = place - vec3(low);
    vec4 sum = vec4(0);
    for (int n = 0; n < 8; ++n) {
        ivec3 d = ivec3(n & 1, n >> 1 & 1, n >> 2);
        vec3 w = mix(1.0 - f, f, vec3(d));
        sum += w.x * w.y * w.z * at(field, low + d);
    }
    return sum;
}

vec3 within(vec3 place) {
    return clamp(place, vec3(0), vec3(cells - 1));
}

// The velocity of an air cell's neighbour along an axis; `side`: 0 for the previous one, 1 for the next one.
vec3 neighbourVelocity(sampler3D velocity, ivec3 c, int axis, int side) {
    ivec3 other = c + (2 * side - 1) * unit(axis);
    if (inside(other)) return isSolid(other) ? texelFetch(solidVelocity, other, 0).xyz : texelFetch(velocity, other, 0).xyz;
    vec3 own = texelFetch(velocity, c, 0).xyz;
    if (sides[2 * axis + side] == 1) own[axis] = 0.0;
    return own;
}

// The divergence times the spacing, by central differences.
float divergenceAt(sampler3D velocity, ivec3 c) {
    float sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) sum += 0.5 * (neighbourVelocity(velocity, c, axis, 1)[axis] - neighbourVelocity(velocity, c, axis, 0)[axis]);
    return sum;
}

// The neighbour's pressure: in a solid and beyond a wall that of the cell itself, beyond an open side 0.
float neighbourPressure(sampler3D pressure, ivec3 c, int axis, int side) {
    ivec3 other = c + (2 * side - 1) * unit(axis);
    float own = texelFetch(pressure, c, 0).r;
    if (inside(other)) return isSolid(other) ? own : texelFetch(pressure, other, 0).r;
    return sides[2 * axis + side] == 0 ? 0.0 : own;
}
