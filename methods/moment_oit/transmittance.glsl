// T(z) = exp(−b₀·share). `share` is the weight before z, plus `overestimation` times the weight at z, of the unique
// measure with these moments that has a point at z. Source: Munstermann2018, 3.2.
// Of eight and of trigonometric moments: canonical_measure.glsl.
/// Roots of c₀ + c₁·x + c₂·x², both real, without the cancellation that a small c₂ causes.
vec2 rootsOfQuadratic(vec3 c) {
    float root = sqrt(max(c.y * c.y - 4.0 * c.x * c.z, 0.0));
    float q = -0.5 * (c.y + (c.y < 0.0 ? -root : root));
    q = abs(q) > 1e-30 ? q : 1e-30;
    return vec2(q / (abs(c.z) > 1e-30 ? c.z : 1e-30), c.x / q);
}

float apart(float a, float b) {
    return abs(a - b) > 1e-7 ? a - b : 1e-7;
}

// Solves H·c = (1, z, z² …) by H = L·D·Lᵀ, where H is the Hankel matrix of the moments. The roots of Σ cᵢ·xⁱ are the
// other points; one of them is far away if the others and z suffice for the moments. The share is the mean, from the
// moments, of the polynomial that is 1 at the points before z, 0 at those beyond, and `overestimation` at z. It is
// built by divided differences. `b` is normalised and biased.
#if MOMENTS == 4
float shareBefore(float b[MOMENTS + 1], float z) {
    float d1 = max(b[2] - b[1] * b[1], 1e-12);
    float l21 = (b[3] - b[1] * b[2]) / d1;
    float d2 = max(b[4] - b[2] * b[2] - l21 * l21 * d1, 1e-12);
    vec3 c = vec3(1.0, z - b[1], z * z - b[2]);
    c.z = (c.z - l21 * c.y) / d2;
    c.y = c.y / d1 - l21 * c.z;
    c.x = 1.0 - b[1] * c.y - b[2] * c.z;

    vec2 x = rootsOfQuadratic(c);
    float f0 = overestimation, f1 = x.x < z ? 1.0 : 0.0, f2 = x.y < z ? 1.0 : 0.0;
    float f01 = (f1 - f0) / apart(x.x, z), f12 = (f2 - f1) / apart(x.y, x.x);
    float f012 = (f12 - f01) / apart(x.y, z);
    // f₀ + f₀₁·(x − z) + f₀₁₂·(x − z)·(x − x₁)
    float share = f0 + f01 * (b[1] - z) + f012 * (b[2] - (z + x.x) * b[1] + z * x.x);
    return clamp(share, 0.0, 1.0);
}
#else
float shareBefore(float b[MOMENTS + 1], float z) {
    float d1 = max(b[2] - b[1] * b[1], 1e-12);
    float l21 = (b[3] - b[1] * b[2]) / d1, l31 = (b[4] - b[1] * b[3]) / d1;
    float d2 = max(b[4] - b[2] * b[2] - l21 * l21 * d1, 1e-12);
    float l32 = (b[5] - b[2] * b[3] - l31 * l21 * d1) / d2;
    float d3 = max(b[6] - b[3] * b[3] - l31 * l31 * d1 - l32 * l32 * d2, 1e-12);
    vec4 c = vec4(1.0, z - b[1], z * z - b[2], z * z * z - b[3]);
    c.z -= l21 * c.y;
    c.w = (c.w - l31 * c.y - l32 * c.z) / d3;
    c.z = c.z / d2 - l32 * c.w;
    c.y = c.y / d1 - l21 * c.z - l31 * c.w;
    c.x = 1.0 - b[1] * c.y - b[2] * c.z - b[3] * c.w;

    // x = y − a: y³ − 3·third·y + 2·around = 0. The largest root is accurate; the others follow without it.
    float least = 1e-5 * max(max(abs(c.x), abs(c.y)), abs(c.z));
    c.w = abs(c.w) > least ? c.w : least;
    float a = c.z / (3.0 * c.w), p = c.y / c.w, q = c.x / c.w;
    float third = max(a * a - p * (1.0 / 3.0), 1e-14), root = sqrt(third);
    float around = a * (a * a - 0.5 * p) + 0.5 * q;
    float angle = acos(clamp(-around / (third * root), -1.0, 1.0)) * (1.0 / 3.0);
    float high = 2.0 * root * cos(angle) - a, low = 2.0 * root * cos(angle + 2.0943951) - a;
    float x1 = abs(high) > abs(low) ? high : low;
    float from = -c.x / x1;
    vec2 x = rootsOfQuadratic(vec3(from, (from - c.y) / x1, c.w));

    float f0 = overestimation, f1 = x1 < z ? 1.0 : 0.0, f2 = x.x < z ? 1.0 : 0.0, f3 = x.y < z ? 1.0 : 0.0;
    float f01 = (f1 - f0) / apart(x1, z), f12 = (f2 - f1) / apart(x.x, x1), f23 = (f3 - f2) / apart(x.y, x.x);
    float f012 = (f12 - f01) / apart(x.x, z), f123 = (f23 - f12) / apart(x.y, x1);
    float f0123 = (f123 - f012) / apart(x.y, z);
    // Means of (x − z), (x − z)·(x − x₁) and (x − z)·(x − x₁)·(x − x₂).
    float first = b[1] - z;
    float second = b[2] - (z + x1) * b[1] + z * x1;
    float thirdMean = b[3] - (z + x1) * b[2] + z * x1 * b[1] - x.x * second;
    return clamp(f0 + f01 * first + f012 * second + f0123 * thirdMean, 0.0, 1.0);
}
#endif
