// Σ α·w·c and Σ α·w of the puffs in front of the scene; and Π(1 − α) if PRODUCT, otherwise the sum of their depths.
// SURFACE: a puff lies at the depth of its centre, with the alpha of its whole chord.
// Source: McGuireBavoil2013, Eq. 6 to 10. Departs: Eq. 10 with the far plane at infinity.
flat in vec4 centre;
flat in float logDepth;
#ifdef COLOURED
flat in vec3 puffColour;
#else
uniform vec3 puffColour;
#endif
uniform vec4 rays;
uniform float nearMetres;
layout(binding = 0) uniform sampler2D sceneDepth;

layout(location = 0) out vec4 weighted;
layout(location = 1) out float revealage;  // blended: PRODUCT multiplies by 1 − this

/// Weight by the distance along the camera's axis and the puff's alpha.
float weightOf(float z, float alpha) {
#if WEIGHT == 7
    float five = z / 5.0, far = z / 200.0;
    return alpha * clamp(10.0 / (1e-5 + five * five + far * far * far * far * far * far), 1e-2, 3e3);
#elif WEIGHT == 8
    float ten = z / 10.0, far = z / 200.0;
    return alpha * clamp(10.0 / (1e-5 + ten * ten * ten + far * far * far * far * far * far), 1e-2, 3e3);
#elif WEIGHT == 9
    float far = z / 200.0;
    return alpha * clamp(0.03 / (1e-5 + far * far * far * far), 1e-2, 3e3);
#elif WEIGHT == 10
    float nearness = nearMetres / max(z, nearMetres);  // 1 − d(z)
    return alpha * max(1e-2, 3e3 * nearness * nearness * nearness);
#else
    return 1.0;
#endif
}

void main() {
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
#if SURFACE == 1
    float axisMetres = -centre.z;
    bool visible = axisMetres > nearMetres && axisMetres * stretch <= scene;
    float depth = visible ? puff.whole : 0.0;
#else
    float axisMetres = clamp(puff.foot, 0.0, scene) / stretch;
    float depth = puff.whole * shareOnRay(puff);
#endif
    float alpha = opacityOf(depth);
    float share = alpha * weightOf(axisMetres, alpha);
    weighted = vec4(share * puffColour, share);
#if PRODUCT == 1
    revealage = alpha;
#else
    revealage = depth;
#endif
}
