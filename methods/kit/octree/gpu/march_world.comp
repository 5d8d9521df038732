// The world of the ray march as seen from an eye, in finest cells: the uniform block World of octree_march.frag.
layout(local_size_x = 1) in;
layout(std430, binding = 2) restrict writeonly buffer World {
    vec4 eyeAndNear, minimumAndLevels, maximumOfAll;
};
layout(std430, binding = 3) restrict readonly buffer Bounds { uint minimum[3], maximum[3]; };
layout(std140, binding = 3) uniform Eye {
    dvec4 eyeAndNearMetres;
};

void main() {
    dvec3 eye = (eyeAndNearMetres.xyz - state.origin.xyz) / edges.x;
    eyeAndNear = vec4(vec3(eye), float(eyeAndNearMetres.w / edges.x));
    // Without voxels: a range that no ray enters.
    bool none = minimum[0] > maximum[0];
    minimumAndLevels = vec4(none ? vec3(1) : vec3(minimum[0], minimum[1], minimum[2]), float(state.first.w));
    maximumOfAll = vec4(none ? vec3(0) : vec3(maximum[0], maximum[1], maximum[2]), 0.0);
}
