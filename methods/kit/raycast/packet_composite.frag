// One pixel of a picture stored in packets of 4×4 pixels (cpu_march.h).
layout(std430, binding = 0) readonly buffer Values {
    float values[];
};
uniform vec2 corner;  // the picture's first pixel
uniform int packetsAcross;
#ifdef ALPHA_ALONE
uniform vec3 reflected;
#endif

layout(location = 0) out vec4 colour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(corner);
    int packet = (pixel.y >> 2) * packetsAcross + (pixel.x >> 2);
    int lane = (pixel.y & 3) * 4 + (pixel.x & 3);
#ifdef ALPHA_ALONE
    float alpha = values[packet * 16 + lane];
    colour = vec4(reflected * alpha, alpha);
#else
    int at = packet * 64 + lane;
    colour = vec4(values[at], values[at + 16], values[at + 32], values[at + 48]);
#endif
}
