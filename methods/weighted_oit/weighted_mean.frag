// The cloud's colour, (Σ α·w·c)/(Σ α·w), premultiplied with its alpha: 1 − Π(1 − α) if PRODUCT, or 1 − exp(−Σ depth).
// Source: McGuireBavoil2013, Eq. 6. Departs: sums that overflow half precision (HALF) end at its largest number.
layout(binding = 0) uniform sampler2D sums;
layout(binding = 1) uniform sampler2D revealages;

layout(location = 0) out vec4 colour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0);
    float stored = texelFetch(revealages, pixel, 0).r;
#if PRODUCT == 1
    float alpha = 1.0 - stored;
#else
    float alpha = opacityOf(stored);
#endif
#if HALF == 1
    sum = min(sum, 65504.0);
    colour = vec4(sum.rgb / max(sum.a, 1e-5) * alpha, alpha);
#else
    colour = sum.a > 0.0 ? vec4(sum.rgb / sum.a * alpha, alpha) : vec4(0);
#endif
}
