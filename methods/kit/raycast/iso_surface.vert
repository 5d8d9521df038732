// A vertex of an isosurface. Positions and normals are along the world's axes.
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
uniform vec3 fromEye;  // the grid's minimum corner relative to the eye
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance

out vec3 facing;

void main() {
    facing = normal;
    vec3 position = mat3(worldToEye) * (place + fromEye);
    gl_Position = vec4(position.xy * projection.xy, projection.z, -position.z);
}
