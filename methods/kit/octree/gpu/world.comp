// Chooses the octree's world, as latticeOver on the CPU (octree_dust.cpp), and prepares the frame's counts and indirect
// dispatches.
layout(local_size_x = 1) in;
layout(std430, binding = 2) restrict readonly buffer Tally { uint puffs; };
layout(std430, binding = 3) restrict buffer Extents { uint minimum[3], maximum[3]; };  // sortable keys

const double vehicleMargin = 0.125lf;

float floatOf(uint key) {
    return uintBitsToFloat((key & 0x80000000u) != 0u ? key & 0x7fffffffu : ~key);
}
bool isFinite(float value) {
    return (floatBitsToUint(value) & 0x7f800000u) != 0x7f800000u;
}

/// The world's centre along an axis: that of the dust, but with the vehicle inside.
double middleAlong(int axis, double edge) {
    float low = floatOf(minimum[axis]), high = floatOf(maximum[axis]);
    bool none = minimum[axis] > maximum[axis];
    if (none || !isFinite(low) || !isFinite(high)) return vehicle[axis];
    precise double farthest = (0.5lf - vehicleMargin) * edge, middle = 0.5lf * (double(low) + double(high));
    precise double lowest = vehicle[axis] - farthest, highest = vehicle[axis] + farthest;
    return clamp(middle, lowest, highest);
}
bool holds(dvec3 origin, double edge) {
    for (int axis = 0; axis < 3; ++axis) {
        if (minimum[axis] > maximum[axis]) continue;
        precise double end = origin[axis] + edge;
        if (double(floatOf(minimum[axis])) < origin[axis] || double(floatOf(maximum[axis])) >= end)
            return false;
    }
    return true;
}
uvec4 groupsFor(uint elements) {
    return uvec4((elements + 255u) / 256u, 1u, 1u, 0u);
}

void main() {
    double edge = vehicle.w;
    int depth = tree.x;
    dvec3 origin;
    for (;; edge *= 2.0lf, ++depth) {
        dvec3 centre = dvec3(middleAlong(0, edge), vehicle.y, middleAlong(2, edge));
        precise dvec3 steps = floor(centre / edges.y + 0.5lf);
        precise dvec3 corner = steps * edges.y - edge / 2.0lf;
        origin = corner;
        if (depth >= tree.z || holds(origin, edge)) break;
    }
    state.origin = dvec4(origin, edge);
    state.first = ivec4(ivec3(round(origin / edges.x)), depth);
    minimum = uint[3](0xffffffffu, 0xffffffffu, 0xffffffffu);  // for the next frame
    maximum = uint[3](0u, 0u, 0u);
    uint second = depth > oneKeyDepth ? puffs : 0u;
    state.counts = uvec4(0u, 0u, puffs, second);
    state.secondGroups = groupsFor(second);
    for (uint level = 0u; level < 3u; ++level) state.blockGroups[level] = groupsFor(puffs >> 4u * (level + 1u));
}
