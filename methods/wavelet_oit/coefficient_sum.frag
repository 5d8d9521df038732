// First pass: sums of the coefficients of all puffs. Coefficient 0 is ∫ A, coefficient 2^j + k is −∫ A·ψ with the Haar
// wavelet ψ = 2^(j/2) on the first half of [k/2^j, (k+1)/2^j), −2^(j/2) on the second. A only grows, so none is negative.
// Source: AizenshteinEtAl2022; Osorio2024.
flat in vec4 centre;
flat in float logDepth;
uniform vec4 rays;
uniform float nearMetres;
layout(binding = 0) uniform sampler2D sceneDepth;

layout(location = 0) out vec4 coefficients[COUNT / 4];

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, pixel, 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
    Seen seen = seenOf(puff, centre, stretch, scene, nearMetres);
    if (seen.depth <= 0.0) discard;
    Part part = partOf(puff, seen, mappingAt(pixel));

    float integral[COUNT + 1], sums[COUNT];
    integral[0] = integralTo(part, 0.0);  // 33 rounds are too many for some compilers to unroll
    for (int i = 1; i <= COUNT; ++i) integral[i] = integralTo(part, float(i) / float(COUNT));
    sums[0] = integral[COUNT] - integral[0];
    for (int j = 0; j <= RANK; ++j)
        for (int k = 0; k < 1 << j; ++k) {
            int cells = COUNT >> j, from = k * cells;
            float bend = integral[from] - 2.0 * integral[from + cells / 2] + integral[from + cells];
            sums[(1 << j) + k] = exp2(0.5 * float(j)) * bend;
        }
    for (int i = 0; i < COUNT / 4; ++i)
        coefficients[i] = vec4(sums[4 * i], sums[4 * i + 1], sums[4 * i + 2], sums[4 * i + 3]);
}
