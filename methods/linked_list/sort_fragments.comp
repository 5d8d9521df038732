// Sorts the list of a pixel from near to far, in place, and blends it:
//
//     C = Σ cᵢ·αᵢ·Tᵢ,   α = Σ αᵢ·Tᵢ,   Tᵢ = Π (1 − αⱼ) over the fragments j in front of i
//
// A merge sort from below: sorted[i] is empty or a sorted list of 2ⁱ fragments. Every fragment is a list of one, and
// two lists of one length merge into the next.
// Source: YangEtAl2010. Departs: lists are sorted in place instead of in an array of limited length.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D picture;

#ifdef COLOURED
layout(std430, binding = 0) readonly buffer Instances {
    float puffs[];  // FLOATS a puff, with red green blue at their end
};
#else
uniform vec3 colourOfAll;
#endif
layout(std430, binding = 1) readonly buffer Heads {
    uint heads[];  // a fragment's number per pixel; 0: none
};
layout(std430, binding = 2) buffer Links {
    uvec2 links[];  // number of the next fragment; number of the puff
};
layout(std430, binding = 3) readonly buffer Fragments {
    vec2 fragments[];  // depth; alpha
};

const int lengths = 32;
uint sorted[lengths];

vec3 colourOf(uint puff) {
#ifdef COLOURED
    uint at = puff * uint(FLOATS) + uint(FLOATS) - 3u;
    return vec3(puffs[at], puffs[at + 1u], puffs[at + 2u]);
#else
    return colourOfAll;
#endif
}

/// By depth. Fragments at one depth follow the order of the puffs.
bool isBefore(uint a, uint b) {
    float first = fragments[a].x, second = fragments[b].x;
    return first < second || (first == second && links[a].y < links[b].y);
}

uint merged(uint a, uint b) {
    uint head = 0u, last = 0u;
    while (a != 0u && b != 0u) {
        uint next = a;
        if (isBefore(b, a)) {
            next = b;
            b = links[b].x;
        } else {
            a = links[a].x;
        }
        if (last == 0u) head = next;
        else links[last].x = next;
        last = next;
    }
    uint rest = a != 0u ? a : b;
    if (last == 0u) return rest;
    links[last].x = rest;
    return head;
}

uint sortedList(uint fragment) {
    for (int i = 0; i < lengths; ++i) sorted[i] = 0u;
    while (fragment != 0u) {
        uint list = fragment;
        fragment = links[fragment].x;
        links[list].x = 0u;
        int i = 0;
        for (; sorted[i] != 0u; ++i) {
            list = merged(sorted[i], list);
            sorted[i] = 0u;
        }
        sorted[i] = list;
    }
    uint all = 0u;
    for (int i = 0; i < lengths; ++i) all = merged(sorted[i], all);
    return all;
}

void main() {
    ivec2 size = imageSize(picture), pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    vec4 blended = vec4(0);
    float transmittance = 1.0;
    for (uint fragment = sortedList(heads[pixel.y * size.x + pixel.x]); fragment != 0u; fragment = links[fragment].x) {
        float alpha = fragments[fragment].y;
        blended += transmittance * alpha * vec4(colourOf(links[fragment].y), 1);
        transmittance *= 1.0 - alpha;
    }
    if (isCutShort()) atomicAdd(unfinished, 1u);
    imageStore(picture, pixel, blended);
}
