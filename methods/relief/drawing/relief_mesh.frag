// A relief as a mesh: surface; lower, upper, left and right rim; back.
in vec3 place;

uniform ivec3 triangles;  // of the surface, of a horizontal rim, of a vertical rim

layout(location = 0) out vec4 colour;

vec3 sideNormal(int n) {
    if (n < 2 * triangles.y) return vec3(0.0, n < triangles.y ? -1.0 : 1.0, 0.0);
    n -= 2 * triangles.y;
    if (n < 2 * triangles.z) return vec3(n < triangles.z ? -1.0 : 1.0, 0.0, 0.0);
    return vec3(0.0, 0.0, -1.0);
}

void main() {
    int side = gl_PrimitiveID - triangles.x;
    vec3 normal = side < 0 ? normalAt(toTexels(place).xy) : sideNormal(side);
    colour = vec4(shaded(place, normal, side < 0 ? albedoAt(place, normal) : plateColour), 1.0);
}
