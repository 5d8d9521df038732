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
    Quad quad = quadOf(mat3(worldToEye) * place, wanted < count ? values[base + 3] : 0.0);
    nearness = quad.nearness;
    vec3 position = cornerOf(quad, corner);
    gl_Position = vec4(position.xy * projection.xy, projection.z, -position.z);

    float depth = max(opticalDepth(values[base + 4]), 1e-30);
#ifdef PLAIN_ALPHA
    puff = vec3(corner, values[base + 4]);
#elif defined(TEXTURED)
    puff = vec3(corner, depth * projection.w);
#else
    puff = vec3(edgeOffset * corner, log2(depth));
#endif
#ifdef TEXTURED
    frame = values[base + 5];
#endif
#ifdef NOISY
    int noise = base + noiseBegin;
    noisePlace = vec3(values[noise], values[noise + 1], values[noise + 2]) +
                 transpose(mat3(worldToEye)) * (position - quad.centre) / values[noise + 3];
#endif
#ifdef SOFT
    toQuad = position;
    toCentre = vec4(quad.centre, sqrt(2.0) / max(quad.radius, 1e-20));
#endif
#ifdef COLOURED
    puffColour = vec3(values[base + FLOATS - 3], values[base + FLOATS - 2], values[base + FLOATS - 1]);
#endif
}
