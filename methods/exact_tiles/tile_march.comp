// Several colours: emission and absorption in slabs, front to back. The slab length of a tile is set by its narrowest
// puff.
//
//     C ← C + (T before − T after)·Σ cᵢ·Δᵢ / Σ Δᵢ,   Δᵢ = τᵢ·exp(−b²/2s²)·½[erf(end) − erf(begin)] of the slab
//
// Depths are closed forms, so α is exact; only colours are assumed to be evenly mixed over a slab. The list is ordered
// by `front` and is traversed once per window of slabs.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D picture;
uniform float slabDeviations;  // length of a slab in units of the smallest s of the tile

const int window = 8;
const float log2e = 1.44269504;
const float opaqueDepth = 20.0;  // T < 2e-9

float depthOf[window];
vec3 colourOf[window];

/// Adds a puff's depth to the slabs. The puff is cut at the scene and lies entirely in front of the eye.
void add(float whole, Foot foot, Puff puff, float windowBegin, float slabMetres, float sceneMetres) {
    float width = puff.optics.z;
    float from = clamp(windowBegin, 0.0, sceneMetres) * width - foot.fromEye;
    float before = errorFunction(from);
    for (int slab = 0; slab < window; ++slab) {
        float to = min((windowBegin + float(slab + 1) * slabMetres) * width - foot.fromEye, foot.toScene);
        float after = errorFunction(max(to, from));
        float depth = whole * 0.5 * (after - before);
        depthOf[slab] += depth;
        colourOf[slab] += depth * puff.colour.rgb;
        before = after;
    }
}

void main() {
    ivec2 size = imageSize(picture), pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 inside = min(pixel, size - 1);
    Ray ray = rayOf(inside, size);
    float sceneMetres = ray.axisMetres * ray.stretch;
    uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uvec2 list = lists[tile];
    uint end = lists[tile + 1u].x;

    float farthest = 0.0, narrowest = 0.0;  // 1/(√2·s)
    for (uint k = list.x; k < end; ++k) {
        farthest = max(farthest, puffs[entries[k]].optics.w);
        narrowest = max(narrowest, puffs[entries[k]].optics.z);
    }
    float slabMetres = slabDeviations * 0.70710678 / narrowest;
    float nearest = list.x < end ? puffs[entries[list.x]].place.w : 0.0;
    float windowMetres = float(window) * slabMetres;
    float begin = floor(nearest / slabMetres) * slabMetres;
    uint first = list.x;
    vec3 colour = vec3(0);
    float sum = 0.0, transmittance = 1.0;
    for (; begin < farthest; begin += windowMetres) {
        if (begin > sceneMetres || sum > opaqueDepth) break;
        for (int slab = 0; slab < window; ++slab) {
            depthOf[slab] = 0.0;
            colourOf[slab] = vec3(0);
        }
        while (first < end && puffs[entries[first]].optics.w < begin) ++first;
        for (uint k = first; k < end; ++k) {
            while (k < end && puffs[entries[k]].optics.w < begin) ++k;
            if (k >= end) break;
            Puff puff = puffs[entries[k]];
            if (puff.place.w > begin + windowMetres) break;
            if (k < list.y) {
                add(depthAroundEye(puff, ray), footAroundEye(puff, ray), puff, begin, slabMetres, sceneMetres);
            } else {
                vec2 offset = offsetOf(puff, inside);
                add(depthAhead(puff, ray, offset), footAhead(puff, ray, offset), puff, begin, slabMetres, sceneMetres);
            }
        }
        for (int slab = 0; slab < window; ++slab) {
            if (depthOf[slab] <= 0.0) continue;
            sum += depthOf[slab];
            float left = exp2(-log2e * sum);
            colour += (transmittance - left) / depthOf[slab] * colourOf[slab];
            transmittance = left;
        }
    }
    if (isCutShort()) atomicAdd(unfinished, 1u);
    if (any(greaterThanEqual(pixel, size))) return;
    float alpha = sum < 0.01 ? sum * (1.0 - sum * (0.5 - sum * (1.0 / 6.0))) : 1.0 - transmittance;
    imageStore(picture, pixel, vec4(colour, alpha));
}
