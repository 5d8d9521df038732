/// A puff along a ray from the eye: its extinction is τ·exp(−b²/2s²)·exp(−x²)/√π, x = (t − tc)/(√2·s), from `begin` to
/// `end`.
struct PuffOnRay {
    float whole;       // τ·exp(−b²/2s²): its depth if uncut
    float foot;        // tc, metres
    float metres;      // √2·s
    float begin, end;  // x at the eye and at the scene
};

/// `centre` is relative to the eye, with 1/(√2·s) in w; `direction` has length 1 and uses the same axes.
PuffOnRay puffOnRay(vec4 centre, float logDepth, vec3 direction, float sceneMetres) {
    PuffOnRay puff;
    puff.foot = dot(centre.xyz, direction);
    vec3 perpendicular = (centre.xyz - puff.foot * direction) * centre.w;
    puff.whole = exp2(logDepth - 1.44269504 * dot(perpendicular, perpendicular));
    puff.metres = 1.0 / centre.w;
    puff.begin = -puff.foot * centre.w;
    puff.end = (sceneMetres - puff.foot) * centre.w;
    return puff;
}

/// Share of the depth between eye and scene: ½·[erf(end) − erf(begin)].
float shareOnRay(PuffOnRay puff) {
    return 0.5 * (errorFunction(puff.end) - errorFunction(puff.begin));
}

/// 1 − exp(−depth); a series where the difference would lose digits.
float opacityOf(float depth) {
    return depth < 0.01 ? depth * (1.0 - depth * (0.5 - depth * (1.0 / 6.0))) : 1.0 - exp(-depth);
}

/// −log2(1 − α)·ln 2 = τ; a series for small α, where 1 − α would lose digits.
float opticalDepth(float opacity) {
    if (opacity > 0.05) return -log(1.0 - opacity);
    return opacity * (1.0 + opacity * (1.0 / 2 + opacity * (1.0 / 3 + opacity * (1.0 / 4 + opacity / 5))));
}

/// The ray through a place of the picture (gl_FragCoord.xy), of length 1 along the camera's axis; eye space.
vec3 rayThrough(vec2 place, vec4 rays) {
    return vec3(place * rays.xy + rays.zw, -1.0);
}

/// Distance along a ray of length `stretch` per axis metre, from the scene's reversed depth.
float sceneMetresOf(float depth, float nearMetres, float stretch) {
    return depth > 0.0 ? nearMetres / depth * stretch : 1e30;
}
