// One layer of a lattice, viewed along −z; the near and far planes clip everything outside it.
layout(location = 0) in vec3 position;
layout(location = 2) in vec3 vertexColour;
uniform vec3 origin;
uniform float edge;
uniform vec2 counts;
uniform float layer;
out vec3 surfaceColour;

void main() {
    vec3 place = (position - origin) / edge;
    // Reversed depth: 1 at the layer's upper side, where the eye is, 0 at its lower side.
    gl_Position = vec4(place.xy / counts * 2.0 - 1.0, place.z - layer, 1.0);
    surfaceColour = vertexColour;
}
