// One vertex per particle, pulled from the instance buffer.
layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z radius opacity red green blue
};
uniform int count;
uniform vec3 eye;
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance
uniform float pixels;
uniform float halfHeight;
flat out vec4 pointColour;

void main() {
    int base = min(gl_VertexID, count - 1) * FLOATS;
    vec3 centre = mat3(worldToEye) * (vec3(values[base], values[base + 1], values[base + 2]) - eye);
    gl_Position = vec4(centre.xy * projection.xy, projection.z, -centre.z);
    float wide = pixels > 0.0 ? pixels : 3.0 * values[base + 3] * projection.y * halfHeight / max(-centre.z, 1e-4);
    gl_PointSize = clamp(wide, 1.0, 255.0);
    float alpha = values[base + 4];
#ifdef SPRITE
    alpha = -log2(1.0 - min(alpha, 0.999));
#endif
    pointColour = vec4(values[base + 5], values[base + 6], values[base + 7], alpha);
}
