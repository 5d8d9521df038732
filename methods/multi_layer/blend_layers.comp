// Blends the puffs of a tile in LAYERS layers per pixel. An invocation owns a pixel; the work group selects the puffs
// that reach into its tile, 64 at a time, and keeps their order.
// SURFACE: a surface at the centre's depth with the alpha of the whole puff along the ray. Otherwise the puff is cut by
// eye and scene and lies at the point on the ray nearest to its centre. Depths are in metres along the camera's axis.
// Source: SalviVaidyanathan2014. Departs: tiles of a compute shader instead of pixel synchronisation.
layout(local_size_x = 8, local_size_y = 8) in;

struct Puff {
    vec4 place;  // world; w: its standard deviation
    vec4 looks;  // colour; w: its optical depth
};
layout(std430, binding = 0) readonly buffer Puffs {
    Puff puffs[];
};
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 0) writeonly uniform image2D picture;
uniform vec4 rays;
uniform float nearMetres;
uniform float reach;  // standard deviations
uniform vec3 eye;
uniform mat4 worldToEye;
uniform int count;

/// Also a fragment: premultiplied colour; transmittance.
struct Layer {
    vec4 looks;
    float depth;
};
Layer layers[LAYERS];

/// Inserts a fragment by its depth. The farthest layer then is one too many and is merged into the one before it, which
/// keeps its depth. Merging an empty layer changes nothing.
void insert(Layer fragment) {
    for (int i = 0; i < LAYERS; ++i) {
        if (fragment.depth < layers[i].depth) {
            Layer pushed = layers[i];
            layers[i] = fragment;
            fragment = pushed;
        }
    }
    vec4 last = layers[LAYERS - 1].looks;
    layers[LAYERS - 1].looks = vec4(last.rgb + last.a * fragment.looks.rgb, last.a * fragment.looks.a);
}

/// A fragment below this would occupy a layer without being visible; also hides rounding of the error function.
const float leastAlpha = 1e-5;
const int puffsAtOnce = 64;
shared vec4 centres[puffsAtOnce];  // eye space; 1/(√2·s)
shared vec4 looksOf[puffsAtOnce];  // colour; log2 of the depth
shared uint selected[2];           // a bit per puff

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
    Puff puff = puffs[i];
    vec3 centre = mat3(worldToEye) * (puff.place.xyz - eye);
    if (!(puff.place.w > 0.0 && puff.looks.w > 0.0 && meets(centre, reach * puff.place.w, cone))) return;
    centres[slot] = vec4(centre, inversesqrt(2.0) / puff.place.w);
    looksOf[slot] = vec4(puff.looks.rgb, log2(puff.looks.w));
    atomicOr(selected[slot >> 5], 1u << (slot & 31));
}

void insertPuff(int slot, vec3 ray, float stretch, float scene) {
    vec4 centre = centres[slot], looks = looksOf[slot];
    PuffOnRay puff = puffOnRay(centre, looks.w, ray / stretch, scene);
    if (puff.whole < exp2(looks.w - 0.72134752 * reach * reach)) return;  // exp(−reach²/2)
#ifdef SURFACE
    float depth = -centre.z;
    bool seen = depth >= nearMetres && depth * stretch <= scene;
    float alpha = seen ? opacityOf(puff.whole) : 0.0;
#else
    float depth = puff.foot / stretch;  // negative behind the eye
    float alpha = opacityOf(puff.whole * shareOnRay(puff));
#endif
    if (alpha > leastAlpha) insert(Layer(vec4(alpha * looks.rgb, 1.0 - alpha), depth));
}

void main() {
    ivec2 size = imageSize(picture), pixel = ivec2(gl_GlobalInvocationID.xy);
    int slot = int(gl_LocalInvocationIndex);
    vec3 ray = rayThrough(vec2(pixel) + 0.5, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, min(pixel, size - 1), 0).r, nearMetres, stretch);
    vec4 cone = coneOfTile();
    for (int i = 0; i < LAYERS; ++i) layers[i] = Layer(vec4(0, 0, 0, 1), 1e30);

    for (int first = 0; first < count; first += puffsAtOnce) {
        if (slot < 2) selected[slot] = 0u;
        barrier();
        selectPuff(slot, first + slot, cone);
        barrier();
        for (int word = 0; word < 2; ++word)
            for (uint left = selected[word]; left != 0u; left &= left - 1u)
                insertPuff(32 * word + findLSB(left), ray, stretch, scene);
        barrier();
    }

    vec4 blended = vec4(0, 0, 0, 1);
    for (int i = 0; i < LAYERS; ++i)
        blended = vec4(blended.rgb + blended.a * layers[i].looks.rgb, blended.a * layers[i].looks.a);
    if (all(lessThan(pixel, size))) imageStore(picture, pixel, vec4(blended.rgb, 1.0 - blended.a));
}
