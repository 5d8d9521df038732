// The puffs that reach into a tile of 8 × 8 pixels, 64 at a time and in the order of their upload (tile_pass.h). An
// invocation owns a pixel of the tile and a slot of the selection.
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) readonly buffer Instances {
    float values[];  // x y z radius opacity [red green blue]
};
#ifdef COUNT_ON_GPU
layout(std430, binding = 7) readonly buffer Drawn {
    int count;
};
#else
uniform int count;
#endif
layout(binding = 0) uniform sampler2D sceneDepth;
uniform vec4 rays;
uniform float nearMetres;
uniform float reach;  // standard deviations
uniform vec3 eye;
uniform mat4 worldToEye;

const int puffsAtOnce = 64;
shared vec4 centres[puffsAtOnce];  // eye space; 1/(√2·s)
shared vec4 looksOf[puffsAtOnce];  // colour; log2 of the optical depth
shared uint selected[2];           // a bit per slot

/// A ray of length 1 per metre along the camera's axis.
struct PixelRay {
    vec3 direction;     // eye space
    float stretch;      // its length
    float sceneMetres;  // distance of the opaque scene along the ray
};

ivec2 pixelOfInvocation() {
    return ivec2(gl_GlobalInvocationID.xy);
}

PixelRay rayOfPixel() {
    ivec2 size = textureSize(sceneDepth, 0);
    PixelRay ray;
    ray.direction = rayThrough(vec2(pixelOfInvocation()) + 0.5, rays);
    ray.stretch = length(ray.direction);
    float depth = texelFetch(sceneDepth, min(pixelOfInvocation(), size - 1), 0).r;
    ray.sceneMetres = sceneMetresOf(depth, nearMetres, ray.stretch);
    return ray;
}

/// A puff that reaches into the tile.
struct TilePuff {
    vec4 centre;  // as in `centres`
    vec4 looks;   // as in `looksOf`
};

#if !defined(COLOURED) && !defined(COLOURLESS)
uniform vec3 colourOfAll;
#endif

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

/// Puts puff `i` into the slot, if it reaches into the tile. `precise`: the same in every pass over the puffs.
void selectPuff(int slot, int i, vec4 cone) {
    if (i >= count) return;
    int base = i * FLOATS;
    precise vec3 centre = mat3(worldToEye) * (vec3(values[base], values[base + 1], values[base + 2]) - eye);
    float radius = values[base + 3], opacity = values[base + 4];
    if (!(radius > 0.0 && opacity > 0.0 && meets(centre, 0.5 * reach * radius, cone))) return;
    centres[slot] = vec4(centre, sqrt(2.0) / radius);
#ifdef COLOURLESS
    vec3 colour = vec3(0);
#elif defined(COLOURED)
    int last = base + FLOATS;
    vec3 colour = vec3(values[last - 3], values[last - 2], values[last - 1]);
#else
    vec3 colour = colourOfAll;
#endif
    looksOf[slot] = vec4(colour, log2(opticalDepth(opacity)));
    atomicOr(selected[slot >> 5], 1u << (slot & 31));
}

PuffOnRay onRay(TilePuff puff, PixelRay ray) {
    return puffOnRay(puff.centre, puff.looks.w, ray.direction / ray.stretch, ray.sceneMetres);
}

/// Whether the ray passes the puff's centre at less than `reach`: its depth is at least exp(−reach²/2) of that through
/// the centre.
bool isWithinReach(TilePuff puff, PuffOnRay there) {
    return there.whole >= exp2(puff.looks.w - 0.72134752 * reach * reach);
}

/// Defined by the method.
void visitPuff(TilePuff puff, PixelRay ray);

void visitPuffsOfTile(PixelRay ray) {
    int slot = int(gl_LocalInvocationIndex);
    vec4 cone = coneOfTile();
    for (int first = 0; first < count; first += puffsAtOnce) {
        if (slot < 2) selected[slot] = 0u;
        barrier();
        selectPuff(slot, first + slot, cone);
        barrier();
        for (int word = 0; word < 2; ++word)
            for (uint left = selected[word]; left != 0u; left &= left - 1u) {
                int visited = 32 * word + findLSB(left);
                visitPuff(TilePuff(centres[visited], looksOf[visited]), ray);
            }
        barrier();
    }
}

/// To be called once, at the end.
void reportLoops() {
    if (isCutShort()) atomicAdd(unfinished, 1u);
}
