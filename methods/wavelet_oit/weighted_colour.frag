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

float sums[COUNT];

/// Mean of A over a cell: its binary digits, from the first, choose the halves of the wavelets that contain it.
float meanOver(int cell) {
    float mean = sums[0];
    for (int j = 0; j <= RANK; ++j) {
        float side = (cell >> (RANK - j) & 1) == 0 ? -1.0 : 1.0;
        mean += side * exp2(0.5 * float(j)) * sums[(1 << j) + (cell >> (RANK + 1 - j))];
    }
    return mean;
}

float ownMeanOver(Part part, int cell) {
    float from = float(cell) / float(COUNT), to = float(cell + 1) / float(COUNT);
    return float(COUNT) * (integralTo(part, to) - integralTo(part, from));
}

/// Between two cells A is linear. A mean applies at the far end of its cell; for volumes, in its middle, which is of
/// order two where A is smooth.
float depthBefore(Part part) {
#ifdef VOLUME
    float place = part.at * float(COUNT) + 0.5;
#else
    float place = part.at * float(COUNT);
#endif
    int cell = min(int(place), COUNT - 1);
    float near = cell == 0 ? 0.0 : meanOver(cell - 1) - ownMeanOver(part, cell - 1);
    float far = meanOver(cell) - ownMeanOver(part, cell);
    return max(mix(near, far, place - float(cell)), 0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, pixel, 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
    Seen seen = seenOf(puff, centre, stretch, scene, nearMetres);
    if (seen.depth <= 0.0) discard;
    for (int i = 0; i < COUNT / 4; ++i) {
        vec4 four = texelFetch(coefficients[i], pixel, 0);
        for (int c = 0; c < 4; ++c) sums[4 * i + c] = four[c];
    }
    float weight = opacityOf(seen.depth) * exp(-depthBefore(partOf(puff, seen, mappingAt(pixel))));
    weighted = vec4(weight * puffColour, weight);
    depthSum = seen.depth;
}
