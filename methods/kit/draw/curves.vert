// VERTICES vertices per particle, pulled from the instance buffer: both ends of every piece of its path.
layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // opacity red green blue, steps to draw, x y z of the last positions, newest first
};
uniform int count;
uniform vec3 eye;
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance
#ifdef FADE
out vec4 lineColour;
#else
flat out vec4 lineColour;
#endif

vec3 positionOf(int base, int k) {
    int first = base + 5 + 3 * k;
    return vec3(values[first], values[first + 1], values[first + 2]);
}

// By steps back: m_k = (x_(k+1) − x_(k−1))/2.
vec3 tangentOf(int base, int k) {
    if (k == 0) return 0.5 * (4.0 * positionOf(base, 1) - 3.0 * positionOf(base, 0) - positionOf(base, 2));
    return 0.5 * (positionOf(base, k + 1) - positionOf(base, k - 1));
}

vec3 pathAt(int base, float back) {
    int k = min(int(back), STEPS - 1);
    float t = back - float(k), s = 1.0 - t;
    return s * s * (1.0 + 2.0 * t) * positionOf(base, k) + t * t * (3.0 - 2.0 * t) * positionOf(base, k + 1) +
           s * s * t * tangentOf(base, k) - t * t * s * tangentOf(base, k + 1);
}

void main() {
    int base = min(gl_VertexID / VERTICES, count - 1) * FLOATS;
    int end = (gl_VertexID % VERTICES + 1) / 2;  // 0 1 1 2 2 3 … of the pieces' ends
    float share = float(end) / float(STEPS * PIECES);
    vec3 position = mat3(worldToEye) * (pathAt(base, share * values[base + 4]) - eye);
    gl_Position = vec4(position.xy * projection.xy, projection.z, -position.z);
    lineColour = vec4(values[base + 1], values[base + 2], values[base + 3], values[base]);
#ifdef FADE
    lineColour.a *= 1.0 - share;
#endif
}
