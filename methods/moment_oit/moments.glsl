// Moments of the optical depth along a ray. MOMENTS is 4, 6 or 8; b[0] of b[0..MOMENTS] is the total depth. The others
// are power moments or, if TRIGONOMETRIC, the real and imaginary parts of moments on a circle. SURFACE: a puff is a
// surface at its centre's depth along the camera's axis. The reference implementation is plain_moments.cpp.
layout(std140, binding = 0) uniform Warp {
    vec2 warp;  // WARP_LOG: ln of the nearest distance, 2/(ln farthest − ln nearest); otherwise the same without ln
};

/// Maps a distance to −1..1.
float warped(float metres) {
#ifdef WARP_LOG
    return (log(metres) - warp.x) * warp.y - 1.0;
#else
    return (metres - warp.x) * warp.y - 1.0;
#endif
}

/// d(warped)/d(metres)
float warpSlope(float metres) {
#ifdef WARP_LOG
    return warp.y / metres;
#else
    return warp.y;
#endif
}

const float leastMetres = 0.001;

/// A puff's extinction between eye and scene: its depth, and mean and variance of x = (t − tc)/(√2·s), from
/// m₀ = ½[erf(e) − erf(b)], mₖ = ½[xᵏ⁻¹·exp(−x²)/√π] from e to b + ½(k − 1)·mₖ₋₂.
struct Profile {
    float depth, mean, variance;
    float moments[MOMENTS + 1];  // mₖ
};

Profile profileOf(PuffOnRay puff) {
    Profile profile;
    float begin = clamp(puff.begin, -6.0, 6.0), end = clamp(puff.end, -6.0, 6.0);
    float atBegin = exp(-begin * begin) * 0.2820947918, atEnd = exp(-end * end) * 0.2820947918;  // exp(−x²)/(2√π)
    profile.moments[0] = shareOnRay(puff);
    profile.moments[1] = atBegin - atEnd;
    for (int k = 2; k <= MOMENTS; ++k) {
        atBegin *= begin;
        atEnd *= end;
        profile.moments[k] = atBegin - atEnd + 0.5 * float(k - 1) * profile.moments[k - 2];
    }
    float share = profile.moments[0];
    profile.depth = puff.whole * share;
    bool isSeen = share > 1e-5;
    profile.mean = isSeen ? clamp(profile.moments[1] / share, begin, end) : clamp(0.0, begin, end);
    profile.variance = isSeen ? max(profile.moments[2] / share - profile.mean * profile.mean, 0.0) : 0.0;
    return profile;
}

#ifdef SURFACE
/// A surface with the depth of the whole puff, if the scene is behind its centre; moves the puff's foot to it.
Profile surfaceOf(inout PuffOnRay puff, vec4 centre, float nearMetres, float axisMetresOfScene) {
    puff.foot = -centre.z;
    bool seen = puff.foot >= nearMetres && puff.foot <= axisMetresOfScene;
    Profile profile;
    profile.depth = seen ? puff.whole : 0.0;
    profile.mean = 0.0;
    profile.variance = 0.0;
    return profile;
}
#endif

#ifdef TRIGONOMETRIC
/// The angle 0 … 2π − WRAPPING_ZONE of a warped distance −1 … 1.
float phaseOf(float z) {
    return (clamp(z, -1.0, 1.0) + 1.0) * (3.14159265 - 0.5 * WRAPPING_ZONE);
}

/// Moments on the circle of a normal distribution with the puff's mean and variance; of a point, the variance is 0.
void momentsOf(PuffOnRay puff, Profile profile, out float b[MOMENTS + 1]) {
    float middle = max(puff.foot + profile.mean * puff.metres, leastMetres);
    float phase = phaseOf(warped(middle));
    float turn = warpSlope(middle) * puff.metres * (3.14159265 - 0.5 * WRAPPING_ZONE);
#ifdef POINTS
    float variance = 0.0;
#else
    float variance = turn * turn * profile.variance;
#endif
    b[0] = profile.depth;
    for (int k = 1; 2 * k <= MOMENTS; ++k) {
        float size = profile.depth * exp(-0.5 * float(k * k) * variance);
        b[2 * k - 1] = size * cos(float(k) * phase);
        b[2 * k] = size * sin(float(k) * phase);
    }
}
#else
/// The moments of a puff: bⱼ = ∫ σ(t)·z(t)ʲ dt, with z linearised at the mean, or as if the whole depth were there.
void momentsOf(PuffOnRay puff, Profile profile, out float b[MOMENTS + 1]) {
    float middle = max(puff.foot + profile.mean * puff.metres, leastMetres);
#ifdef POINTS
    float z = warped(middle);
    b[0] = profile.depth;
    for (int j = 1; j <= MOMENTS; ++j) b[j] = b[j - 1] * z;
#else
    float slope = warpSlope(middle);
    float z = warped(middle) + slope * (puff.foot - middle), width = slope * puff.metres;
    // E[xⁱ·(z + width·x)ʲ⁺¹] = z·E[xⁱ·(…)ʲ] + width·E[xⁱ⁺¹·(…)ʲ]
    float m[MOMENTS + 1] = profile.moments;
    for (int j = 0; j <= MOMENTS; ++j) {
        b[j] = puff.whole * m[0];
        for (int i = 0; i < MOMENTS - j; ++i) m[i] = z * m[i] + width * m[i + 1];
    }
#endif
}
#endif
