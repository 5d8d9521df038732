// A puff's weight, opacity and depth at a pixel. SURFACE: it lies at the depth of its centre, with the alpha of its whole
// chord.
// Source: McGuireBavoil2013, Eq. 6 to 10. Departs: Eq. 10 with the far plane at infinity.
uniform float nearMetres;

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

struct WeightedPuff {
    float share;  // α·w
    float alpha;
    float depth;
};

/// `ray` has the length `stretch`; centre and depth as in PuffQuads.
WeightedPuff weightedPuff(vec4 centre, float logDepth, vec3 ray, float stretch, float scene) {
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
    WeightedPuff weighted;
#if SURFACE == 1
    float axisMetres = -centre.z;
    bool visible = axisMetres > nearMetres && axisMetres * stretch <= scene;
    weighted.depth = visible ? puff.whole : 0.0;
#else
    float axisMetres = clamp(puff.foot, 0.0, scene) / stretch;
    weighted.depth = puff.whole * shareOnRay(puff);
#endif
    weighted.alpha = opacityOf(weighted.depth);
    weighted.share = weighted.alpha * weightOf(axisMetres, weighted.alpha);
    return weighted;
}
