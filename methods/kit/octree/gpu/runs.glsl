// Sorted particles, and which of them share a voxel.
layout(std430, binding = 1) restrict readonly buffer Keys { uint keys[]; };
layout(std430, binding = 2) restrict readonly buffer Indices { uint indices[]; };
layout(std430, binding = 3) restrict readonly buffer Places { uvec2 places[]; };

bool shareVoxel(uint k, uint l) {
    return hasOneKey() ? keys[k] == keys[l] : places[indices[k]] == places[indices[l]];
}
