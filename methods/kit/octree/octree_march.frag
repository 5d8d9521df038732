// Marches front to back along the pixel's ray through the cells of an octree; exact for constant extinction per cell.
//
//     D ← D + σ·Δ,   T = exp2(−D),   C ← C + (T before − T after)·colour
//
// The tree is stored in textures, because storage buffers read in this loop gave wrong values on llvmpipe (Mesa 22.3).
// Axes along which the ray runs backwards are mirrored, so that it always runs towards higher cells. Its position is
// the finest cell that contains it: steps move from cell to cell in integers, and each advances along one axis without
// moving back along another, so that rounding can neither skip a cell nor cause an endless loop.
layout(binding = 1) uniform sampler2D slots;  // octree_march.h, row after row
#ifdef COLOURED
layout(binding = 2) uniform sampler2D colours;
#else
uniform vec3 colourOfAll;
#endif
layout(binding = 0) uniform sampler2D sceneDepth;

// Lengths are in finest cells. A ray's parameter is the distance along the camera's axis, as in the depth buffer.
#ifdef WORLD_ON_GPU
layout(std140, binding = 3) uniform World {
    vec4 eyeAndNear, minimumAndLevels, maximumOfAll;
};
#else
uniform int levels;
uniform vec3 eye;                         // from the world's minimum corner
uniform vec3 minimum, maximum;  // cells [minimum, maximum) contain all voxels
uniform float nearDistance;
#endif
uniform vec3 rayCorner, rayRight, rayUp;  // the ray through the image's corner, and its change per pixel

layout(location = 0) out vec4 colour;

const float opaqueDepth = 14.0;  // in powers of 2: T < 2^-14

ivec2 placeOf(int index) {
    return ivec2(index & (1 << ROW_BITS) - 1, index >> ROW_BITS);
}

void main() {
    colour = vec4(0);
#ifdef WORLD_ON_GPU
    int levels = int(minimumAndLevels.w);
    vec3 eye = eyeAndNear.xyz, minimum = minimumAndLevels.xyz, maximum = maximumOfAll.xyz;
    float nearDistance = eyeAndNear.w;
#endif
    vec3 ray = rayCorner + gl_FragCoord.x * rayRight + gl_FragCoord.y * rayUp;
    float stretch = length(ray);

    bvec3 back = lessThan(ray, vec3(0));
    int world = 1 << levels;
    vec3 from = mix(eye, float(world) - eye, back);
    ivec3 first = ivec3(mix(minimum, world - maximum, back)), last = ivec3(mix(maximum, world - minimum, back));
    int mirrored = (back.x ? 4 : 0) | (back.y ? 2 : 0) | (back.z ? 1 : 0);
    ray = max(abs(ray), 1e-12);  // finite quotients; no ray gets this far
    vec3 perRay = 1.0 / ray;

    vec3 enter = (vec3(first) - from) * perRay, leave = (vec3(last) - from) * perRay;
    float t = max(max(enter.x, enter.y), max(enter.z, 0.0));
    float end = min(min(leave.x, leave.y), leave.z);
    end = min(end, nearDistance / max(texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, 1e-9));
    if (t >= end) return;

    ivec3 cell = clamp(ivec3(from + t * ray), first, last - 1);
    float depth = 0.0, opaque = opaqueDepth / stretch;
#ifdef COLOURED
    float transmittance = 1.0;
#endif

    // Blocks on the path down, by the bit of the cell that selects among their slots: a step moves up only as far as
    // the cell's bits have changed. Twice as fast as restarting from the root.
    int stack[12];
    int bit = levels - 1;
    stack[bit] = 0;
    for (int steps = 3 << levels; steps > 0; --steps) {
        int block = stack[bit];
        int index;
        float slot;
        for (;;) {
            ivec3 side = cell >> bit & 1;
            index = 8 * block + ((side.x << 2 | side.y << 1 | side.z) ^ mirrored);
            slot = texelFetch(slots, placeOf(index), 0).r;
            if (slot <= 0.0 || bit == 0) break;
            block = int(slot);
            --bit;
            stack[bit] = block;
        }
        ivec3 lastCell = cell | (1 << bit) - 1;
        vec3 exits = (vec3(lastCell + 1) - from) * perRay;
        float leaving = min(min(exits.x, exits.y), exits.z);
        float next = clamp(leaving, t, end);
        depth -= slot * (next - t);
        t = next;
#ifdef COLOURED
        if (slot < 0.0) {
            float left = exp2(-depth * stretch);
            colour.rgb += (transmittance - left) * texelFetch(colours, placeOf(index), 0).rgb;
            transmittance = left;
        }
#endif
        if (leaving >= end || depth > opaque) break;
        ivec3 there = clamp(ivec3(from + t * ray), cell, lastCell);
        there = mix(there, lastCell + 1, lessThanEqual(exits, vec3(leaving)));
        if (any(greaterThanEqual(there, last))) break;
        ivec3 changed = there ^ cell;
        bit = findMSB(changed.x | changed.y | changed.z);
        cell = there;
    }
    float alpha = 1.0 - exp2(-depth * stretch);
#ifdef COLOURED
    colour.a = alpha;
#else
    colour = vec4(colourOfAll * alpha, alpha);
#endif
}
