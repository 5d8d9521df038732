// Particles that share a voxel: which one represents it, and their optical mass (octree_settings.h).
layout(std430, binding = 4) restrict readonly buffer Lives { float lives[]; };
layout(std430, binding = 5) restrict readonly buffer Looks { float looks[]; };
layout(std430, binding = 6) restrict readonly buffer Serials { uvec2 serials[]; };

/// Of some particles: the one that represents them, its priority, and their mass, m²; 0 unless the policy accumulates.
struct Sum {
    uint winner, priority;
    double mass;
};
const Sum nobody = Sum(nowhere, 0u, 0.0lf);

bool accumulates() {
    return rules.x == policyAccumulate;
}
float opacityOf(uint i) {
    if (rules.z == 0) return looks[2u * i + 1u];
    precise float left = 1.0 - quotient(lives[2u * i], lives[2u * i + 1u]);
    precise float opacity = scales.w * clamp(left, 0.0, 1.0);
    return opacity;
}
/// Edge of a voxel this many levels above the finest, m.
double edgeOf(uint rise) {
    return edges.x * double(1u << rise);
}
double radiusOf(uint i, uint rise) {
    return double(rules.z == 0 ? looks[2u * i] : quotient(float(edgeOf(rise)), 1.2533141));
}

const double reciprocals[13] = double[13](1.0lf, 1.0lf / 3.0lf, 1.0lf / 5.0lf, 1.0lf / 7.0lf, 1.0lf / 9.0lf,
                                          1.0lf / 11.0lf, 1.0lf / 13.0lf, 1.0lf / 15.0lf, 1.0lf / 17.0lf,
                                          1.0lf / 19.0lf, 1.0lf / 21.0lf, 1.0lf / 23.0lf, 1.0lf / 25.0lf);
/// τ = −ln(1 − α), by ln((1 + s)/(1 − s)) = 2·(s + s³/3 + s⁵/5 + …).
double opticalDepthOf(float opacity) {
    double a = double(opacity), ofHalvings = 0.0lf, numerator = a, denominator = 2.0lf - a;
    if (a >= 1.0lf) return packDouble2x32(uvec2(0u, 0x7ff00000u));
    if (a > 0.25lf) {
        double m = 1.0lf - a;
        while (m < 0.7lf) {
            m *= 2.0lf;
            ofHalvings += 0.693147180559945309417lf;
        }
        numerator = 1.0lf - m, denominator = 1.0lf + m;
    }
    double s = numerator / denominator, square = s * s, series = 0.0lf;
    for (int power = 12; power >= 0; --power) series = series * square + reciprocals[power];
    return ofHalvings + 2.0lf * s * series;
}
/// τ·2π·s², s = r/2
double massOf(uint i, uint rise) {
    double s = radiusOf(i, rise) / 2.0lf;
    return opticalDepthOf(opacityOf(i)) * 2.0lf * 3.141592653589793238463lf * s * s;
}

uint priorityOf(uint i) {
    return rules.x == policyMax ? floatBitsToUint(opacityOf(i)) : ~floatBitsToUint(lives[2u * i]);
}
bool isFirstBorn(uint a, uint b) {
    uvec2 first = serials[a], second = serials[b];
    return first.y != second.y ? first.y < second.y : first.x < second.x;
}
/// The higher priority wins, ties go to the lower serial.
bool wins(Sum challenger, Sum holder) {
    if (holder.winner == nowhere) return true;
    if (challenger.priority != holder.priority) return challenger.priority > holder.priority;
    return isFirstBorn(challenger.winner, holder.winner);
}
Sum sumOf(uint i, uint rise) {
    Sum sum = Sum(i, priorityOf(i), 0.0lf);
    if (accumulates()) sum.mass = massOf(i, rise);
    return sum;
}
/// `more` is of one particle at least.
Sum added(Sum to, Sum more) {
    precise double mass = to.mass + more.mass;
    return wins(more, to) ? Sum(more.winner, more.priority, mass) : Sum(to.winner, to.priority, mass);
}

uvec4 wordsOf(Sum sum) {
    return uvec4(sum.winner, sum.priority, unpackDouble2x32(sum.mass));
}
Sum sumIn(uvec4 words) {
    return Sum(words.x, words.y, packDouble2x32(words.zw));
}
