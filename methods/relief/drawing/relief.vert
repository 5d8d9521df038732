// A box around the plate of a panel as twelve triangles, from the vertex number alone.
uniform mat4 panelToClip;
#ifdef CURVED
uniform vec3 boxLow, boxHigh;
#endif

out vec3 place;  // in the panel's frame: where the ray leaves the box

// Corners of a cube as one triangle strip: bit k of each word is the side of vertex k along x, y and z.
const ivec3 strip = ivec3(0x287a, 0x02af, 0x31e3);

void main() {
    vec3 side = vec3(strip >> gl_VertexID & 1);
#ifdef CURVED
    place = mix(boxLow, boxHigh, side);
#else
    place = vec3((2.0 * side.xy - 1.0) * plate.xy, (side.z - 1.0) * plate.z);
#endif
    gl_Position = panelToClip * vec4(place, 1.0);
}
