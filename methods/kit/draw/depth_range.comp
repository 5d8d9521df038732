// The nearest and the farthest distance of all puffs, then the mapping from them (depth_mapping.h). Floats from 0 on are
// in the order of their bits, and minima and maxima do not depend on the order of puffs.
layout(std430, binding = 0) restrict buffer Ends { uint nearest, farthest; };

#ifdef MAPPING
layout(local_size_x = 1) in;
layout(std430, binding = 1) restrict writeonly buffer Mapping { vec2 mapping; };
uniform float nearMetres;

void main() {
    mapping = mappingOf(uintBitsToFloat(nearest), uintBitsToFloat(farthest), nearMetres);
}
#else
layout(local_size_x = 256) in;
layout(std430, binding = 1) restrict readonly buffer Positions { float positions[]; };
layout(std430, binding = 2) restrict readonly buffer Looks { float looks[]; };  // radius, opacity
layout(std430, binding = 3) restrict readonly buffer Tally { uint puffs; };
uniform vec4 eye;  // w: the near plane
uniform vec3 ahead;

shared uint nearestOfGroup, farthestOfGroup;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (gl_LocalInvocationIndex == 0u) nearestOfGroup = 0x7f7fffffu, farthestOfGroup = 0u;
    barrier();
    if (i < puffs) {
        vec3 centre = vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]) - eye.xyz;
        vec2 extent = extentOf(dot(centre, ahead), length(centre), 0.5 * looks[2u * i], eye.w);
        if (extent.y >= 0.0) {
            atomicMin(nearestOfGroup, floatBitsToUint(max(extent.x, 0.0)));
            atomicMax(farthestOfGroup, floatBitsToUint(extent.y));
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        atomicMin(nearest, nearestOfGroup);
        atomicMax(farthest, farthestOfGroup);
    }
}
#endif
