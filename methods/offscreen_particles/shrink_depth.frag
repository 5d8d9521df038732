// Depth of a texel of the small picture: the farthest of the pixels that it covers. Source: Cantlay2007.
layout(binding = 0) uniform sampler2D sceneDepth;
uniform vec2 smallSize;

void main() {
    ivec2 size = textureSize(sceneDepth, 0), small = ivec2(smallSize), texel = ivec2(gl_FragCoord.xy);
    ivec2 first = texel * size / small, end = ((texel + 1) * size + small - 1) / small;
    float farthest = 1.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) farthest = min(farthest, texelFetch(sceneDepth, ivec2(x, y), 0).r);
    gl_FragDepth = farthest;
}
