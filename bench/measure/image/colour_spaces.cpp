#include "bench/measure/image/colour_spaces.h"

#include <cmath>

namespace dustbench::measure {
namespace {

/// X : Y : Z of a chromaticity (x, y), with Y = 1.
glm::dvec3 whole(double x, double y) {
    return {x / y, 1, (1 - x - y) / y};
}

/// D65, from its five-digit chromaticity.
const glm::dvec3 white = whole(0.31271, 0.32902);

/// The primaries' luminances sum to white: M = P·diag(P⁻¹·w).
glm::dmat3 xyzOfPrimaries() {
    const glm::dmat3 primaries(whole(0.64, 0.33), whole(0.30, 0.60), whole(0.15, 0.06));
    const glm::dvec3 brightness = glm::inverse(primaries) * white;
    return {primaries[0] * brightness[0], primaries[1] * brightness[1], primaries[2] * brightness[2]};
}

/// X, Y, Z relative to white.
glm::dmat3 relativeXyz() {
    glm::dmat3 matrix = xyzOfPrimaries();
    for (int column = 0; column < 3; ++column) matrix[column] /= white;
    return matrix;
}

const glm::mat3 relativeXyzFromLinear(relativeXyz());
const glm::mat3 linearFromRelativeXyz(glm::inverse(relativeXyz()));

constexpr float knee = 6.0f / 29;

float compress(float t) {
    return t > knee * knee * knee ? std::cbrt(t) : t / (3 * knee * knee) + 4.0f / 29;
}
float expand(float f) {
    return f > knee ? f * f * f : 3 * knee * knee * (f - 4.0f / 29);
}

/// (116 y − 16, 500 (x − y), 200 (y − z)) and back.
glm::vec3 opponent(glm::vec3 v) {
    return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}
glm::vec3 fromOpponent(glm::vec3 v) {
    const float y = (v.x + 16) / 116;
    return {y + v.y / 500, y, y - v.z / 200};
}

}  // namespace

glm::vec3 opponentFromLinear(glm::vec3 rgb) {
    return opponent(relativeXyzFromLinear * rgb);
}

glm::vec3 linearFromOpponent(glm::vec3 yCxCz) {
    return linearFromRelativeXyz * fromOpponent(yCxCz);
}

glm::vec3 labFromLinear(glm::vec3 rgb) {
    const glm::vec3 xyz = relativeXyzFromLinear * rgb;
    return opponent({compress(xyz.x), compress(xyz.y), compress(xyz.z)});
}

glm::vec3 linearFromLab(glm::vec3 lab) {
    const glm::vec3 f = fromOpponent(lab);
    return linearFromRelativeXyz * glm::vec3(expand(f.x), expand(f.y), expand(f.z));
}

}  // namespace dustbench::measure
