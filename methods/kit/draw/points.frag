// A flat square or a round sprite, premultiplied. `a` is the opacity; for a sprite, τ·log2(e) at its centre.
flat in vec4 pointColour;
layout(location = 0) out vec4 colour;

void main() {
    float alpha = pointColour.a;
#ifdef SPRITE
    vec2 offset = gl_PointCoord * 2.0 - 1.0;
    // b = 3s at the rim: b²/2s²·log2(e) = 9/2·log2(e)·|offset|²
    alpha = 1.0 - exp2(-pointColour.a * exp2(-6.49212768 * dot(offset, offset)));
#endif
#ifdef ADDITIVE
    colour = vec4(pointColour.rgb * alpha, 0.0);
#else
    colour = vec4(pointColour.rgb * alpha, alpha);
#endif
}
