// Depth for the pass at full resolution: the scene's at edges. Elsewhere the near plane, which hides every puff.
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(sceneDepth, pixel, 0).r;
    gl_FragDepth = atEdge(depth, tapsAround(pixel)) ? depth : 1.0;
}
