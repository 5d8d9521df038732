// Enlarges the small picture. MIXED: pixels at edges come from the pass at full resolution.
layout(binding = 2) uniform sampler2D smallColour;
#ifdef MIXED
layout(binding = 3) uniform sampler2D edgeColour;
#endif
layout(location = 0) out vec4 colour;

#if UPSAMPLING == DEPTH
/// The bilinear mean of the texels on the pixel's own surface; without any, the texel with the closest depth.
vec4 enlarged(float depth, Taps taps) {
    vec4 sum = vec4(0);
    float weight = 0.0;
    int closest = 0;
    for (int i = 0; i < 4; ++i) {
        if (abs(taps.depth[i] - depth) < abs(taps.depth[closest] - depth)) closest = i;
        if (!sameSurface(depth, taps.depth[i])) continue;
        sum += taps.weight[i] * texelFetch(smallColour, taps.place[i], 0);
        weight += taps.weight[i];
    }
    return weight > 0.0 ? sum / weight : texelFetch(smallColour, taps.place[closest], 0);
}
#elif UPSAMPLING == BILINEAR
vec4 enlarged(float depth, Taps taps) {
    vec4 sum = vec4(0);
    for (int i = 0; i < 4; ++i) sum += taps.weight[i] * texelFetch(smallColour, taps.place[i], 0);
    return sum;
}
#else
vec4 enlarged(float depth, Taps taps) {
    int nearest = 0;
    for (int i = 1; i < 4; ++i)
        if (taps.weight[i] > taps.weight[nearest]) nearest = i;
    return texelFetch(smallColour, taps.place[nearest], 0);
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(sceneDepth, pixel, 0).r;
    Taps taps = tapsAround(pixel);
#ifdef MIXED
    if (atEdge(depth, taps)) {
        colour = texelFetch(edgeColour, pixel, 0);
        return;
    }
#endif
    colour = enlarged(depth, taps);
}
