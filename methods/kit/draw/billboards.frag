// Opacity of a puff along the pixel's ray: α(b) = 1 − exp(−τ·exp(−b²/2s²)), premultiplied with its colour. PLAIN_ALPHA:
// the puff's opacity times that of a picture or of a smoothly faded circle.
in vec3 puff;
flat in float nearness;
#ifdef SOFT
in vec3 toQuad;
flat in vec4 toCentre;
uniform float nearMetres;
layout(binding = 1) uniform sampler2D sceneDepth;
#endif
#ifdef TEXTURED
flat in float frame;
uniform float shadeScale;
layout(binding = 0) uniform sampler2DArray pictures;
#endif
#ifdef NOISY
in vec3 noisePlace;
uniform float noise;
#endif
#ifdef MOVING
uniform float share;
#else
const float share = 1.0;
#endif
#ifdef COLOURED
flat in vec3 puffColour;
#else
uniform vec3 puffColour;
#endif
layout(location = 0) out vec4 colour;

#ifdef SOFT
/// Fraction of the puff's depth between the eye and the scene: ½·[erf((t1 − tc)/√2s) − erf((0 − tc)/√2s)].
float shareBeforeScene() {
    float rayLength = length(toQuad);
    // Reversed depth is near distance / distance along the axis; gl_FragCoord.w is 1 / the quad's distance along the
    // axis.
    float depth = texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r;
    float scene = nearMetres / max(depth, 1e-9) * rayLength * gl_FragCoord.w;
    float foot = dot(toCentre.xyz, toQuad) / rayLength;
    return 0.5 * (errorFunction((scene - foot) * toCentre.w) + errorFunction(foot * toCentre.w));
}
#endif

/// With PLAIN_ALPHA `depth` is not an optical depth, but an opacity.
void main() {
#ifdef TEXTURED
    vec2 place = 0.5 * puff.xy + 0.5;
#ifdef CROSS_FADED
    float earlier = floor(frame);
    vec4 texel = mix(texture(pictures, vec3(place, earlier)), texture(pictures, vec3(place, earlier + 1.0)),
                     frame - earlier);
#else
    vec4 texel = texture(pictures, vec3(place, frame));
#endif
    float depth = puff.z * texel.a;
    vec3 lit = puffColour * (shadeScale * texel.rgb);
#elif defined(PLAIN_ALPHA)
    float u = min(length(puff.xy), 1.0);
    float depth = puff.z * (1.0 - u * u * (3.0 - 2.0 * u));
    vec3 lit = puffColour;
#else
    // On a plane at the centre's distance d, the ray at offset u passes the centre at b² = u²/(1 + u²/d²).
    float offset = dot(puff.xy, puff.xy);
    float depth = exp2(puff.z - offset / (1.0 + offset * nearness));
    vec3 lit = puffColour;
#endif
#ifdef SOFT
    depth *= shareBeforeScene();
#endif
#ifdef NOISY
    depth *= 1.0 + noise * puffNoise(noisePlace);
#endif
#ifdef PLAIN_ALPHA
    float alpha = share * min(depth, 1.0);
#elif defined(ADDITIVE)
    float alpha = share * (1.0 - exp2(-depth));
#else
    float alpha = 1.0 - exp2(-share * depth);
#endif
#ifdef ADDITIVE
    colour = vec4(lit * alpha, 0.0);
#else
    colour = vec4(lit * alpha, alpha);
#endif
}
