// The share of the depth before z for eight power moments and for trigonometric ones, as `shareBefore` of
// transmittance.glsl. `b` is normalised and biased.
//
// The moments' matrix M (Hankel or Toeplitz) gives the polynomial c = M⁻¹·(1, z, z² …), whose roots and z are the points
// of the one measure with these moments and a point at z. M = L·D·L* also gives the weight of a point x:
// 1/Σ |yⱼ|²/dⱼ, L·y = (1, x, x² …). Roots are found as those of a real polynomial whose roots are all real and not far
// away: of 1/(x − s) with s outside of −1..1, or of the cotangent of half the angle from a place on the circle.
//
// Source: Munstermann2018, 3.2. Departs: weights by the factorisation instead of divided differences; Euler's
// solution of the quartic, polished by Newton's method, instead of Neumark's; real roots also on the circle.

const int points = MOMENTS / 2 + 1;
#ifdef TRIGONOMETRIC
const int degree = MOMENTS / 2;
#else
const int degree = 4;
#endif

/// Roots of y³ + b·y² + c·y + d, all of them real.
vec3 rootsOfCubic(float b, float c, float d) {
    float a = b / 3.0, third = max(a * a - c / 3.0, 1e-20), root = sqrt(third);
    float around = a * (a * a - 0.5 * c) + 0.5 * d;
    float angle = acos(clamp(-around / (third * root), -1.0, 1.0)) / 3.0;
    return 2.0 * root * cos(angle - vec3(0.0, 2.0943951, 4.1887902)) - a;
}

/// Roots of yⁿ + Σ c[k]·yᵏ, n = `degree`, all of them real.
void realRoots(float c[degree], out float roots[degree]) {
#if MOMENTS == 4
    float middle = -0.5 * c[1], apart = sqrt(max(middle * middle - c[0], 0.0));
    roots[0] = middle < 0.0 ? middle - apart : middle + apart;
    roots[1] = abs(roots[0]) > 1e-20 ? c[0] / roots[0] : 0.0;
#elif MOMENTS == 6
    vec3 three = rootsOfCubic(c[2], c[1], c[0]);
    roots[0] = three.x, roots[1] = three.y, roots[2] = three.z;
#else
    // y = x − a: x⁴ + p·x² + q·x + r. Its roots are (±√u₁ ±√u₂ ±√u₃)/2, with u of u³ + 2p·u² + (p² − 4r)·u − q² = 0.
    float a = 0.25 * c[3], p = c[2] - 6.0 * a * a, q = c[1] - 2.0 * a * c[2] + 8.0 * a * a * a;
    float r = c[0] - a * c[1] + a * a * c[2] - 3.0 * a * a * a * a;
    vec3 s = 0.5 * sqrt(max(rootsOfCubic(2.0 * p, p * p - 4.0 * r, -q * q), 0.0));
    float e = q > 0.0 ? -1.0 : 1.0;
    roots[0] = s.x + s.y + e * s.z - a;
    roots[1] = s.x - s.y - e * s.z - a;
    roots[2] = -s.x + s.y - e * s.z - a;
    roots[3] = -s.x - s.y + e * s.z - a;
#endif
#if MOMENTS > 4
    for (int i = 0; i < degree; ++i)
        for (int step = 0; step < 2; ++step) {
            float value = 1.0, slope = 0.0;
            for (int k = degree - 1; k >= 0; --k) {
                slope = slope * roots[i] + value;
                value = value * roots[i] + c[k];
            }
            float change = abs(slope) > 1e-6 ? value / slope : 0.0;
            roots[i] -= clamp(change, -0.01, 0.01);
        }
#endif
}

#ifdef TRIGONOMETRIC
vec2 times(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}
vec2 conjugate(vec2 a) {
    return vec2(a.x, -a.y);
}
vec2 circlePoint(float angle) {
    return vec2(cos(angle), sin(angle));
}

float shareBefore(float b[MOMENTS + 1], float z) {
    // T[j][k] = b_(j−k) = L·D·L*
    vec2 lower[points * points];
    float d[points];
    for (int j = 0; j < points; ++j)
        for (int k = 0; k <= j; ++k) {
            int n = j - k;
            vec2 sum = n == 0 ? vec2(1, 0) : vec2(b[max(2 * n - 1, 0)], b[2 * n]);
            for (int i = 0; i < k; ++i)
                sum -= d[i] * times(lower[j * points + i], conjugate(lower[k * points + i]));
            if (k < j)
                lower[j * points + k] = sum / d[k];
            else
                d[j] = max(sum.x, 1e-9);
        }
    float phase = phaseOf(z);
    vec2 x[points];
    x[0] = circlePoint(phase);

    vec2 c[points];
    for (int j = 0; j < points; ++j) {
        c[j] = circlePoint(float(j) * phase);
        for (int k = 0; k < j; ++k) c[j] -= times(lower[j * points + k], c[k]);
    }
    for (int j = points - 1; j >= 0; --j) {
        c[j] /= d[j];
        for (int k = j + 1; k < points; ++k) c[j] -= times(conjugate(lower[k * points + j]), c[k]);
    }
    // Σ c*ₖ·xᵏ on the circle: x = g·(t + i)/(t − i), with g far from all roots, so that no t is far away.
    vec2 g = vec2(1, 0), atG = vec2(0);
    for (int n = 0; n < 8; ++n) {
        vec2 place = circlePoint(0.78539816 * float(n)), value = vec2(0);
        for (int k = points - 1; k >= 0; --k) value = times(value, place) + conjugate(c[k]);
        if (dot(value, value) > dot(atG, atG)) g = place, atG = value;
    }
    // Horner's scheme for Σ c*ₖ·gᵏ·(t + i)ᵏ·(t − i)ⁿ⁻ᵏ.
    vec2 sum[points], tail[points];
    for (int k = 0; k < points; ++k) sum[k] = tail[k] = vec2(0);
    sum[0] = conjugate(c[degree]);
    tail[0] = vec2(1, 0);
    for (int n = degree - 1; n >= 0; --n) {
        for (int k = degree; k >= 0; --k) {
            vec2 s = times(g, vec2(-sum[k].y, sum[k].x)), t = vec2(tail[k].y, -tail[k].x);  // i·g·sum, −i·tail
            sum[k] = k > 0 ? s + times(g, sum[k - 1]) : s;
            tail[k] = k > 0 ? t + tail[k - 1] : t;
        }
        for (int k = 0; k < points; ++k) sum[k] += times(conjugate(c[n]), tail[k]);
    }
    float real[degree], t[degree];
    float size = max(dot(atG, atG), 1e-30);
    for (int k = 0; k < degree; ++k) real[k] = dot(sum[k], atG) / size;
    realRoots(real, t);
    for (int i = 0; i < degree; ++i)
        x[i + 1] = times(g, vec2(t[i] * t[i] - 1.0, 2.0 * t[i])) / (t[i] * t[i] + 1.0);

    float before = 0.0, all = 0.0;
    for (int i = 0; i < points; ++i) {
        vec2 y[points];
        float inverse = 0.0;
        vec2 power = vec2(1, 0);
        for (int j = 0; j < points; ++j) {
            y[j] = power;
            for (int k = 0; k < j; ++k) y[j] -= times(lower[j * points + k], y[k]);
            inverse += dot(y[j], y[j]) / d[j];
            power = times(power, x[i]);
        }
        float angle = atan(x[i].y, x[i].x);
        if (angle < 0.0) angle += 6.2831853;
        float inZone = clamp((angle - 6.2831853) / WRAPPING_ZONE + 1.0, 0.0, 1.0);
        all += 1.0 / inverse;
        before += (i == 0 ? overestimation : angle < phase ? 1.0 : inZone) / inverse;
    }
    return clamp(before / all, 0.0, 1.0);
}
#else
float shareBefore(float b[MOMENTS + 1], float z) {
    // H[j][k] = b_(j+k) = L·D·Lᵀ
    float lower[points * points], d[points];
    for (int j = 0; j < points; ++j)
        for (int k = 0; k <= j; ++k) {
            float sum = b[j + k];
            for (int i = 0; i < k; ++i) sum -= d[i] * lower[j * points + i] * lower[k * points + i];
            if (k < j)
                lower[j * points + k] = sum / d[k];
            else
                d[j] = max(sum, 1e-9);
        }
    float c[points], x[points];
    x[0] = z;
    float power = 1.0;
    for (int j = 0; j < points; ++j) {
        c[j] = power;
        for (int k = 0; k < j; ++k) c[j] -= lower[j * points + k] * c[k];
        power *= z;
    }
    for (int j = points - 1; j >= 0; --j) {
        c[j] /= d[j];
        for (int k = j + 1; k < points; ++k) c[j] -= lower[k * points + j] * c[k];
    }
    // At most one root is outside of −1..1: s is on the other side. Taylor's series at s, in y = 1/(x − s).
    float low = 0.0, high = 0.0;
    for (int k = degree; k >= 0; --k) {
        low = low * -2.0 + c[k];
        high = high * 2.0 + c[k];
    }
    float s = abs(low) > abs(high) ? -2.0 : 2.0;
    for (int n = 0; n < degree; ++n)
        for (int k = degree - 1; k >= n; --k) c[k] += s * c[k + 1];
    float inverseRoots[degree], monic[degree];
    float first = abs(c[0]) > 1e-30 ? c[0] : 1e-30;
    for (int k = 0; k < degree; ++k) monic[k] = c[degree - k] / first;
    realRoots(monic, inverseRoots);
    for (int i = 0; i < degree; ++i) {
        float y = inverseRoots[i];
        x[i + 1] = s + 1.0 / (abs(y) > 1e-3 ? y : y < 0.0 ? -1e-3 : 1e-3);  // farther away, a point weighs nothing
    }
    float before = 0.0, all = 0.0;
    for (int i = 0; i < points; ++i) {
        float y[points], inverse = 0.0, powerOfX = 1.0;
        for (int j = 0; j < points; ++j) {
            y[j] = powerOfX;
            for (int k = 0; k < j; ++k) y[j] -= lower[j * points + k] * y[k];
            inverse += y[j] * y[j] / d[j];
            powerOfX *= x[i];
        }
        all += 1.0 / inverse;
        before += (i == 0 ? overestimation : x[i] < z ? 1.0 : 0.0) / inverse;
    }
    return clamp(before / all, 0.0, 1.0);
}
#endif
