// Second pass: Σ w·c and Σ w, w = α·exp(−A), A the optical depth of the other puffs in front; and Σ depth.
// Source: AizenshteinEtAl2022; Osorio2024 (A between two cells, without the puff's own part).
flat in vec4 centre;
flat in float logDepth;
#ifdef COLOURED
flat in vec3 puffColour;
#else
uniform vec3 puffColour;
#endif
uniform vec4 rays;
uniform float nearMetres;
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 1) uniform sampler2D coefficients[COUNT / 4];

layout(location = 0) out vec4 weighted;
layout(location = 1) out float depthSum;

float means[COUNT];  // of A over each cell

/// From coarse to fine, each wavelet splits a cell: less in its near half, more in its far half.
void findMeans(ivec2 pixel) {
    float sums[COUNT];
    for (int i = 0; i < COUNT / 4; ++i) {
        vec4 four = texelFetch(coefficients[i], pixel, 0);
        for (int c = 0; c < 4; ++c) sums[4 * i + c] = four[c];
    }
    means[0] = sums[0];
    for (int j = 0; j <= RANK; ++j)
        for (int k = (1 << j) - 1; k >= 0; --k) {
            float bend = exp2(0.5 * float(j)) * sums[(1 << j) + k], whole = means[k];
            means[2 * k] = whole - bend;
            means[2 * k + 1] = whole + bend;
        }
}

float ownMeanOver(Part part, float cell) {
    return float(COUNT) * (integralTo(part, (cell + 1.0) / float(COUNT)) - integralTo(part, cell / float(COUNT)));
}

/// Between two cells A is linear. A mean applies at the far end of its cell; for volumes, in its middle, which is of
/// order two where A is smooth.
float depthBefore(Part part) {
    float place = part.at * float(COUNT);
#ifdef VOLUME
    place = min(place + 0.5, float(COUNT));
#endif
    float all = 0.0;
    for (int i = 0; i < COUNT; ++i) all += max(1.0 - abs(place - float(i + 1)), 0.0) * means[i];
    float cell = min(floor(place), float(COUNT - 1)), share = place - cell;
    float own = share * ownMeanOver(part, cell);
    if (cell > 0.0) own += (1.0 - share) * ownMeanOver(part, cell - 1.0);
    return max(all - own, 0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, pixel, 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
    Seen seen = seenOf(puff, centre, stretch, scene, nearMetres);
    if (seen.depth <= 0.0) discard;
    findMeans(pixel);
    float weight = opacityOf(seen.depth) * exp(-depthBefore(partOf(puff, seen, mappingAt(pixel))));
    weighted = vec4(weight * puffColour, weight);
    depthSum = seen.depth;
}
