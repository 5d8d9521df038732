// The puffs that reach into a tile of 8 × 8 pixels, 64 at a time and in their order in memory. An invocation owns a
// pixel of the tile and a slot of the selection.
layout(local_size_x = 8, local_size_y = 8) in;

struct Puff {
    vec4 place;  // world; w: its standard deviation
    vec4 looks;  // colour; w: its optical depth
};
layout(std430, binding = 0) readonly buffer Puffs {
    Puff puffs[];
};
uniform vec4 rays;
uniform float reach;  // standard deviations
uniform vec3 eye;
uniform mat4 worldToEye;
uniform int count;

const int puffsAtOnce = 64;
shared vec4 centres[puffsAtOnce];  // eye space; 1/(√2·s)
shared vec4 looksOf[puffsAtOnce];  // colour; log2 of the depth
shared uint selected[2];           // a bit per slot

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

/// Puts puff `i` into the slot, if it reaches into the tile.
void selectPuff(int slot, int i, vec4 cone) {
    if (i >= count) return;
    Puff puff = puffs[i];
    precise vec3 centre = mat3(worldToEye) * (puff.place.xyz - eye);
    if (!(puff.place.w > 0.0 && puff.looks.w > 0.0 && meets(centre, reach * puff.place.w, cone))) return;
    centres[slot] = vec4(centre, inversesqrt(2.0) / puff.place.w);
    looksOf[slot] = vec4(puff.looks.rgb, log2(puff.looks.w));
    atomicOr(selected[slot >> 5], 1u << (slot & 31));
}
