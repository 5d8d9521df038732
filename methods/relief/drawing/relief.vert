// The plate of a panel as a box of twelve triangles, from the vertex number alone. A box that is partly beside the picture
// would be cut, with cracks along its triangles' edges: then one triangle covers the whole picture instead.
uniform mat4 panelToClip, clipToPanel;
uniform int wholePicture;

out vec3 place;  // in the panel's frame: where the ray leaves the plate, or any other place on it

// Corners of a cube as one triangle strip: bit k of each word is the side of vertex k along x, y and z.
const ivec3 strip = ivec3(0x287a, 0x02af, 0x31e3);

void main() {
    if (wholePicture == 1) {
        vec2 corner = vec2(gl_VertexID >> 1, gl_VertexID & 1) * 4.0 - 1.0;  // clockwise: its back is seen
        vec4 near = clipToPanel * vec4(corner, 1.0, 1.0);
        place = near.xyz / near.w;
        gl_Position = vec4(corner, 0.0, 1.0);
        return;
    }
    vec3 side = vec3(strip >> gl_VertexID & 1);
    place = vec3((2.0 * side.xy - 1.0) * plate.xy, (side.z - 1.0) * plate.z);
    gl_Position = panelToClip * vec4(place, 1.0);
}
