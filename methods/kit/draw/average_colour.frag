// C = (Σ w·c)/(Σ w)·α, α = 1 − exp(−Σ depth)
layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D depths;

layout(location = 0) out vec4 colour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(colours, pixel, 0);
    float depth = texelFetch(depths, pixel, 0).r;
    // A series for small depths, where the difference would lose digits.
    float alpha = depth < 0.01 ? depth * (1.0 - depth * (0.5 - depth * (1.0 / 6.0))) : 1.0 - exp(-depth);
    colour = sum.a > 0.0 ? vec4(sum.rgb / sum.a * alpha, alpha) : vec4(0);
}
