// A single colour: Σ τ·exp(−b²/2s²)·½[erf((t1 − tc)/√2s) − erf((0 − tc)/√2s)] over the tile's list, α = 1 − exp(−Σ).
//
// An invocation sums ROWS pixels of a column. This helps software renderers, which read a puff once per lane.
layout(local_size_x = 8, local_size_y = 8 / ROWS) in;
layout(binding = 0) writeonly uniform image2D picture;
uniform vec3 colourOfAll;

const float log2e = 1.44269504;

void main() {
    ivec2 size = imageSize(picture), first = ivec2(gl_GlobalInvocationID.xy) * ivec2(1, ROWS);
    Ray rays[ROWS];
    float sums[ROWS];
    float nearest = 1e30;
    for (int row = 0; row < ROWS; ++row) {
        rays[row] = rayOf(min(first + ivec2(0, row), size - 1), size);
        sums[row] = 0.0;
        nearest = min(nearest, rays[row].axisMetres);
    }
    uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uvec2 list = lists[tile];
    uint end = lists[tile + 1u].x;
    for (uint k = list.x; k < list.y; ++k) {
        Puff puff = puffs[entries[k]];
        for (int row = 0; row < ROWS; ++row) {
            Foot foot = footAroundEye(puff, rays[row]);
            float share = 0.5 * (errorFunction(foot.toScene) + errorFunction(foot.fromEye));
            sums[row] += depthAroundEye(puff, rays[row]) * share;
        }
    }
    // The list is ordered by `back`: first the puffs that end before the nearest surface, then those it may cut.
    uint k = list.y;
    for (; k < end; ++k) {
        Puff puff = puffs[entries[k]];
        if (puff.optics.w > nearest) break;
        vec2 offset = offsetOf(puff, first);
        for (int row = 0; row < ROWS; ++row) sums[row] += depthAhead(puff, rays[row], offset + vec2(0, row));
    }
    for (; k < end; ++k) {
        Puff puff = puffs[entries[k]];
        vec2 offset = offsetOf(puff, first);
        for (int row = 0; row < ROWS; ++row) {
            vec2 there = offset + vec2(0, row);
            float share = 0.5 + 0.5 * errorFunction(footAhead(puff, rays[row], there).toScene);
            sums[row] += depthAhead(puff, rays[row], there) * share;
        }
    }
    if (isCutShort()) atomicAdd(unfinished, 1u);
    for (int row = 0; row < ROWS; ++row) {
        ivec2 pixel = first + ivec2(0, row);
        if (any(greaterThanEqual(pixel, size))) continue;
        // 1 − exp(−Σ); a series where the difference would lose digits.
        float sum = sums[row];
        float alpha = sum < 0.01 ? sum * (1.0 - sum * (0.5 - sum * (1.0 / 6.0))) : 1.0 - exp2(-log2e * sum);
        imageStore(picture, pixel, vec4(colourOfAll * alpha, alpha));
    }
}
