// Curl of the velocity in 1/s, and its magnitude.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 5) restrict writeonly buffer Curl { vec4 curl[]; };
uniform float spacing;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c), row = stepAlong(1), slab = stepAlong(2);
    float perTwoCells = isFluid(cell) ? 0.5 / spacing : 0.0;
    vec3 alongX = moving[cell + 1].xyz - moving[cell - 1].xyz;
    vec3 alongY = moving[cell + row].xyz - moving[cell - row].xyz;
    vec3 alongZ = moving[cell + slab].xyz - moving[cell - slab].xyz;
    vec3 w = vec3(alongY.z - alongZ.y, alongZ.x - alongX.z, alongX.y - alongY.x) * perTwoCells;
    curl[cell] = vec4(w, length(w));
}
