// weighted_sum.frag and weighted_mean.frag in one: the sums of a tile's puffs stay in the invocations of its pixels.
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 0) writeonly uniform image2D layer;
uniform vec3 puffColour;  // unless instances have their own
uniform vec4 rays;

shared vec4 centres[shapesAtOnce];  // eye space; 1/(√2·s)
shared vec4 looks[shapesAtOnce];    // colour; log2 of the depth
shared uint irregular[shapesAtOnce];

void prepareShape(uint slot, uint shape, ivec2 tilePixel) {
    PuffQuad quad = quadOfShape(shape);
    if (quad.side == 0.0) return;
    uvec2 covered = uvec2(0xffffffffu);
    irregular[slot] = 0u;
    if (quad.side > 0.0) {
        Outline outline = outlineOf(cornersOf(quad));
        if (outline.regular) covered = coverageOf(outline, tilePixel);
        else irregular[slot] = 1u;
    }
    cover(slot, covered);
    if (covered == uvec2(0)) return;
    uint base = shape * uint(floats);
    centres[slot] = vec4(quad.centre, sqrt(2.0) / values[base + 3u]);
    vec3 colour = floats == 8 ? vec3(values[base + 5u], values[base + 6u], values[base + 7u]) : puffColour;
    looks[slot] = vec4(colour, log2(max(opticalDepth(values[base + 4u]), 1e-30)));
}

vec3 ray;
float stretch, scene;
vec4 sum;
float sumOfDepths;

void drawShape(uint slot) {
    vec4 centre = centres[slot], look = looks[slot];
    if (irregular[slot] != 0u && !meets(puffQuadOf(centre.xyz, inversesqrt(2.0) * reach / centre.w), ray)) return;
    WeightedPuff puff = weightedPuff(centre, look.w, ray, stretch, scene);
    sum += puff.share * vec4(look.rgb, 1.0);
    sumOfDepths += puff.depth;
}

bool needsMore() {
    return true;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ray = rayThrough(vec2(pixel) + 0.5, rays);
    stretch = length(ray);
    scene = sceneMetresOf(texelFetch(sceneDepth, min(pixel, picture.xy - 1), 0).r, nearMetres, stretch);
    sum = vec4(0);
    sumOfDepths = 0.0;
    if (!drawTile() || any(greaterThanEqual(pixel, picture.xy))) return;
    float alpha = opacityOf(sumOfDepths);
    imageStore(layer, pixel, sum.a > 0.0 ? vec4(sum.rgb / sum.a * alpha, alpha) : vec4(0));
}
