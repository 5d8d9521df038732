// Appends a puff's fragment to the list of its pixel. Fragments that find no room are only counted.
// SURFACE: a surface at the centre's depth with the alpha of the whole puff along the ray. Otherwise the puff is cut by
// eye and scene and lies at the point on the ray nearest to its centre. Depths are in metres along the camera's axis.
// Source: YangEtAl2010. Departs: number, depth and alpha of the puff are stored instead of its colour.
flat in vec4 centre;
flat in float logDepth;
flat in int puffIndex;
uniform vec4 rays;
uniform float nearMetres;
uniform int pictureWidth;
layout(binding = 0) uniform sampler2D sceneDepth;

layout(std430, binding = 1) buffer Heads {
    uint heads[];  // a fragment's number per pixel; 0: none
};
layout(std430, binding = 2) writeonly buffer Links {
    uvec2 links[];  // number of the next fragment; number of the puff
};
layout(std430, binding = 3) writeonly buffer Fragments {
    vec2 fragments[];  // depth; alpha
};
layout(std430, binding = 4) buffer Counter {
    uint found, foundHigh;  // fragments, in 64 bits
};

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, pixel, 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
#ifdef SURFACE
    float depth = -centre.z;
    bool seen = depth >= nearMetres && depth * stretch <= scene;
    float alpha = seen ? opacityOf(puff.whole) : 0.0;
#else
    float depth = puff.foot / stretch;  // negative behind the eye
    float alpha = opacityOf(puff.whole * shareOnRay(puff));
#endif
    if (alpha > 0.0) {
        uint before = atomicAdd(found, 1u);
        if (before == 0xffffffffu) atomicAdd(foundHigh, 1u);
        uint fragment = before + 1u;  // number 0 ends a list
        if (before < uint(links.length()) - 1u) {
            uint next = atomicExchange(heads[pixel.y * pictureWidth + pixel.x], fragment);
            links[fragment] = uvec2(next, uint(puffIndex));
            fragments[fragment] = vec2(depth, alpha);
        }
    }
    discard;
}
