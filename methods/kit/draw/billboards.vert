// Corners of camera-facing quads, pulled from the instance buffer: SHAPES_AT_ONCE quads per drawn instance.
layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z radius opacity [frame] [displacement] [noise] [red green blue]
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
#ifdef MOVING
uniform float back;
#ifdef TEXTURED
const int displacement = 6;
#else
const int displacement = 5;
#endif
#endif
uniform vec4 projection;  // x and y scale, near distance, optical depth scale of the puff picture

out vec3 puff;           // offset from the centre, such that |offset|² = b²/(2s²)·log2(e); optical depth.
                         // PLAIN_ALPHA: place on the quad, −1 to 1; opacity
flat out float nearness;  // (offset length 1 / distance)²
#ifdef SOFT
out vec3 toQuad;  // eye space
flat out vec4 toCentre;  // eye space; 1/(√2·s)
#endif
#ifdef TEXTURED
flat out float frame;
#endif
#ifdef NOISY
out vec3 noisePlace;
#ifdef COLOURED
const int noiseBegin = FLOATS - 7;
#else
const int noiseBegin = FLOATS - 4;
#endif
#endif
#ifdef COLOURED
flat out vec3 puffColour;
#endif

const float log2e = 1.44269504;

/// −log2(1 − α) = τ·log2(e); a series for small α, where 1 − α would lose digits.
float opticalDepth(float opacity) {
    if (opacity > 0.05) return -log2(1.0 - opacity);
    return log2e * opacity * (1.0 + opacity * (1.0 / 2 + opacity * (1.0 / 3 + opacity * (1.0 / 4 + opacity / 5))));
}

void main() {
    int wanted = gl_InstanceID * SHAPES_AT_ONCE + (gl_VertexID >> 2);
    int base = min(wanted, count - 1) * FLOATS;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1 & 1) * 2.0 - 1.0;

    // Subtract the eye first, so that coordinates near the eye keep their precision.
    vec3 place = vec3(values[base], values[base + 1], values[base + 2]) - eye;
#ifdef MOVING
    int at = base + displacement;
    place -= back * vec3(values[at], values[at + 1], values[at + 2]);
#endif
    vec3 centre = mat3(worldToEye) * place;
    float distance = length(centre);
    bool drawn = wanted < count && distance > 1e-4;
    float radius = drawn ? values[base + 3] : 0.0;

#ifdef VIEWPLANE
    vec3 right = vec3(1, 0, 0), up = vec3(0, 1, 0);
    nearness = 0.0;
#else
    // Perpendicular to the ray to the centre; `right` stays horizontal in the image.
    vec3 sight = drawn ? centre / distance : vec3(0, 0, -1);
    vec3 right = vec3(-sight.z, 0, sight.x) * inversesqrt(max(sight.x * sight.x + sight.z * sight.z, 1e-12));
    vec3 up = cross(right, sight);
    float share = radius / max(distance, 1e-4);
    nearness = share * share / (2.0 * log2e);
#endif
    vec3 position = centre + 1.5 * radius * (corner.x * right + corner.y * up);
    gl_Position = vec4(position.xy * projection.xy, projection.z, -position.z);

    // 1.5 r = 3s: |offset|² = 9/2·log2(e) in the middle of an edge.
    float edge = 1.5 * sqrt(2.0 * log2e);
    float depth = max(opticalDepth(values[base + 4]), 1e-30);
#ifdef PLAIN_ALPHA
    puff = vec3(corner, values[base + 4]);
#elif defined(TEXTURED)
    puff = vec3(corner, depth * projection.w);
#else
    puff = vec3(edge * corner, log2(depth));
#endif
#ifdef TEXTURED
    frame = values[base + 5];
#endif
#ifdef NOISY
    int noise = base + noiseBegin;
    noisePlace = vec3(values[noise], values[noise + 1], values[noise + 2]) +
                 transpose(mat3(worldToEye)) * (position - centre) / values[noise + 3];
#endif
#ifdef SOFT
    toQuad = position;
    toCentre = vec4(centre, sqrt(2.0) / max(radius, 1e-20));
#endif
#ifdef COLOURED
    puffColour = vec3(values[base + FLOATS - 3], values[base + FLOATS - 2], values[base + FLOATS - 1]);
#endif
}
