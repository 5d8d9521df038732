// The surface colour, which becomes the voxel's.
in vec3 surfaceColour;
layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(surfaceColour, 1.0);
}
