// A relief as a mesh with a vertex per texel, from the vertex number alone: the corners of the patches row by row, plus
// one more all around at the rim, and then the same again at the bottom.
uniform mat4 panelToClip;

out vec3 place;  // in the frame of the relief

void main() {
    ivec2 corners = ivec2(texels) + 2;
    int surface = corners.x * corners.y, n = gl_VertexID % surface;
    ivec2 corner = ivec2(n % corners.x, n / corners.x) - 1;
    vec2 at = clamp(vec2(corner), vec2(-0.5), texels - 0.5);
    float depth = gl_VertexID < surface ? depthOf(corner) : 1.0;
    place = vec3(((at + 0.5) / texels * 2.0 - 1.0) * plate.xy, -depth * plate.z);
    gl_Position = panelToClip * vec4(onPanel(place), 1.0);
}
