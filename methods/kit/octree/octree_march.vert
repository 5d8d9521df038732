// Covers the pixels whose rays may hit a box: draws the faces of the box that face the eye, or the whole image.
#ifdef WORLD_ON_GPU
const bool wholePicture = true;
const vec3 boxMinimum = vec3(0), boxMaximum = vec3(0), projection = vec3(0);
const mat4 worldToEye = mat4(1);
#else
uniform bool wholePicture;
uniform vec3 boxMinimum, boxMaximum;  // relative to the eye, along the world's axes
uniform mat4 worldToEye;
uniform vec3 projection;  // x and y scale, near distance
#endif

void main() {
    if (wholePicture) {
        gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
        return;
    }
    // Six faces of two triangles, counter-clockwise as seen from outside.
    int face = gl_VertexID / 6, axis = face >> 1, side = face & 1;
    int corner = int[6](0, 1, 2, 2, 1, 3)[gl_VertexID % 6];
    ivec2 uv = ivec2(corner & 1, corner >> 1);
    if (side == 0) uv = uv.yx;
    vec3 at;
    at[axis] = side;
    at[(axis + 1) % 3] = uv.x;
    at[(axis + 2) % 3] = uv.y;
    vec3 position = mat3(worldToEye) * mix(boxMinimum, boxMaximum, at);
    gl_Position = vec4(position.xy * projection.xy, projection.z, -position.z);
}
