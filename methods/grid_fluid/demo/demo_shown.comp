// Copies a component of a field for the ray caster.
layout(binding = 0) uniform sampler3D field;
layout(binding = 0, r32f) restrict writeonly uniform image3D shown;
uniform int component;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (inside(c)) imageStore(shown, c, vec4(texelFetch(field, c, 0)[component]));
}
