// The particle's colour, premultiplied.
#ifdef FADE
in vec4 lineColour;
#else
flat in vec4 lineColour;
#endif
layout(location = 0) out vec4 colour;

void main() {
#ifdef ADDITIVE
    colour = vec4(lineColour.rgb * lineColour.a, 0.0);
#else
    colour = vec4(lineColour.rgb * lineColour.a, lineColour.a);
#endif
}
