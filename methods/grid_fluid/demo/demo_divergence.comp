// The divergence times the spacing; 0 in solids.
layout(binding = 0) uniform sampler3D velocity;
layout(binding = 0, rgba16f) restrict writeonly uniform image3D result;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    imageStore(result, c, vec4(isSolid(c) ? 0.0 : divergenceAt(velocity, c), 0, 0, 0));
}
