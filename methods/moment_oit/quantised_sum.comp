// First pass with 16-bit moments: after each puff, the moments of all so far are rounded.
// An invocation owns a pixel of a tile of 8 × 8; the work group selects the puffs that reach into the tile, 64 at a
// time, and keeps their order.
// Source: Munstermann2018. Departs: tiles of a compute shader instead of rasteriser-ordered views; b₀ in 32 bits.
layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z radius opacity [red green blue]
};
layout(std430, binding = 1) writeonly buffer Stored {
    uint stored[];  // pairs of 16-bit moments, MOMENTS/2 per pixel
};
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 1, r32f) writeonly uniform image2D total;  // b₀
uniform vec4 rays;
uniform float nearMetres;
uniform float reach;  // standard deviations
uniform vec3 eye;
uniform mat4 worldToEye;
uniform int count;

const int puffsAtOnce = 64;
shared vec4 centres[puffsAtOnce];  // eye space; 1/(√2·s)
shared float depths[puffsAtOnce];
shared uint selected[2];  // a bit per puff

/// The cone around the tile's rays: its axis, and the cosine of the angle to its farthest corner.
vec4 coneOfTile() {
    vec2 low = vec2(gl_WorkGroupID.xy * 8u);
    vec3 axis = normalize(rayThrough(low + 4.0, rays));
    float cosine = 1.0;
    for (int corner = 0; corner < 4; ++corner) {
        vec2 place = low + 8.0 * vec2(corner & 1, corner >> 1);
        cosine = min(cosine, dot(axis, normalize(rayThrough(place, rays))));
    }
    return vec4(axis, cosine);
}

/// Whether the ball with the radius `metres` meets the cone, by the cosine of the sum of both angles.
bool meets(vec3 centre, float metres, vec4 cone) {
    float distance = length(centre);
    if (distance <= metres) return true;
    float sine = metres / distance, cosine = sqrt(1.0 - sine * sine);
    float least = cosine * cone.w - sine * sqrt(max(1.0 - cone.w * cone.w, 0.0));
    return dot(centre, cone.xyz) / distance >= least - 1e-5;
}

void selectPuff(int slot, int i, vec4 cone) {
    if (i >= count) return;
    int base = i * FLOATS;
    vec3 centre = mat3(worldToEye) * (vec3(values[base], values[base + 1], values[base + 2]) - eye);
    float radius = values[base + 3], depth = opticalDepth(values[base + 4]);
    if (!(radius > 0.0 && depth > 0.0 && meets(centre, 0.5 * reach * radius, cone))) return;
    centres[slot] = vec4(centre, sqrt(2.0) / radius);
    depths[slot] = depth;
    atomicOr(selected[slot >> 5], 1u << (slot & 31));
}

void addPuff(int slot, vec3 ray, float stretch, float scene, inout float whole, inout float q[MOMENTS]) {
    vec4 centre = centres[slot];
    PuffOnRay puff = puffOnRay(centre, log2(depths[slot]), ray / stretch, scene);
    if (puff.whole < depths[slot] * exp(-0.5 * reach * reach)) return;
#ifdef SURFACE
    Profile profile = surfaceOf(puff, centre, nearMetres, scene / stretch);
#else
    Profile profile = profileOf(puff);
#endif
    if (profile.depth < 1e-7) return;
    float b[MOMENTS + 1], one[MOMENTS];
    momentsOf(puff, profile, b);
    for (int j = 1; j <= MOMENTS; ++j) b[j] /= b[0];
    quantise(b, one);
    float sum = whole + b[0];
    for (int j = 0; j < MOMENTS; ++j)
        q[j] = floor(clamp((q[j] * whole + one[j] * b[0]) / sum, 0.0, 1.0) * 65535.0 + 0.5) / 65535.0;
    whole = sum;
}

void main() {
    ivec2 size = imageSize(total), pixel = ivec2(gl_GlobalInvocationID.xy);
    int slot = int(gl_LocalInvocationIndex);
    vec3 ray = rayThrough(vec2(pixel) + 0.5, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, min(pixel, size - 1), 0).r, nearMetres, stretch);
    vec4 cone = coneOfTile();
    float whole = 0.0, q[MOMENTS];
    for (int j = 0; j < MOMENTS; ++j) q[j] = 0.0;

    for (int first = 0; first < count; first += puffsAtOnce) {
        if (slot < 2) selected[slot] = 0u;
        barrier();
        selectPuff(slot, first + slot, cone);
        barrier();
        for (int word = 0; word < 2; ++word)
            for (uint left = selected[word]; left != 0u; left &= left - 1u)
                addPuff(32 * word + findLSB(left), ray, stretch, scene, whole, q);
        barrier();
    }

    if (!all(lessThan(pixel, size))) return;
    int begin = (pixel.y * size.x + pixel.x) * (MOMENTS / 2);
    for (int k = 0; k < MOMENTS / 2; ++k) stored[begin + k] = packUnorm2x16(vec2(q[2 * k], q[2 * k + 1]));
    imageStore(total, pixel, vec4(whole, 0, 0, 0));
}
