// Quads that cover all rays which pass a puff's centre at less than `reach` s. One around the eye covers the picture.
layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z radius opacity [red green blue]
};
#ifdef COUNT_ON_GPU
layout(std430, binding = 7) readonly buffer Drawn {
    int count;
};
#else
uniform int count;
#endif
uniform vec3 eye;
uniform mat4 worldToEye;
uniform vec4 projection;  // x and y scale, near distance, reach in s

flat out vec4 centre;  // eye space; 1/(√2·s)
flat out float logDepth;
flat out int puffIndex;  // the puff's place in the upload
#ifdef COLOURED
flat out vec3 puffColour;
#endif

void main() {
    int wanted = gl_InstanceID * SHAPES_AT_ONCE + (gl_VertexID >> 2);
    int base = min(wanted, count - 1) * FLOATS;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1 & 1) * 2.0 - 1.0;

    // Subtract the eye first, so that coordinates near the eye keep their precision.
    vec3 place = mat3(worldToEye) * (vec3(values[base], values[base + 1], values[base + 2]) - eye);
    float radius = values[base + 3], depth = opticalDepth(values[base + 4]);
    bool drawn = wanted < count && radius > 0.0 && depth > 0.0;
    PuffQuad quad = puffQuadOf(place, drawn ? 0.5 * radius * projection.w : 0.0);
    vec3 position = place + quad.side * (corner.x * quad.right + corner.y * quad.up);
    gl_Position = vec4(position.xy * projection.xy, projection.z, -position.z);
    if (quad.side == 0.0) gl_Position = vec4(0, 0, 0, 1);
    if (quad.side < 0.0) gl_Position = vec4(corner, 0, 1);
    centre = vec4(place, sqrt(2.0) / max(radius, 1e-20));
    puffIndex = min(wanted, count - 1);
    logDepth = log2(max(depth, 1e-30));
#ifdef COLOURED
    puffColour = vec3(values[base + FLOATS - 3], values[base + FLOATS - 2], values[base + FLOATS - 1]);
#endif
}
