// The particle's colour, premultiplied.
flat in vec4 lineColour;
layout(location = 0) out vec4 colour;

void main() {
#ifdef ADDITIVE
    colour = vec4(lineColour.rgb * lineColour.a, 0.0);
#else
    colour = vec4(lineColour.rgb * lineColour.a, lineColour.a);
#endif
}
