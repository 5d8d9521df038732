#include "methods/kit/draw/puff_noise.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/maths/philox.h"

namespace dustbench::draw {
namespace {

constexpr std::uint32_t noiseStream = 9;
constexpr float offsetCells = 256;  ///< offsets are in 0..256, where floats resolve a cell finely

std::uint32_t latticeHash(const glm::ivec3& cell) {
    const glm::uvec3 c(cell);
    std::uint32_t h = c.x * 0x8da6b343u ^ c.y * 0xd8163841u ^ c.z * 0xcb1ab31fu;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

/// The scalar product of one of the twelve vectors to the middles of a cube's edges with `d`.
float alongEdge(std::uint32_t hash, const glm::vec3& d) {
    const std::uint32_t edge = hash % 12u;
    const float u = edge < 8u ? d.x : d.y, v = edge < 4u ? d.y : d.z;
    return ((edge & 1u) != 0 ? -u : u) + ((edge & 2u) != 0 ? -v : v);
}

float gradientNoise(const glm::vec3& q) {
    const glm::vec3 floor = glm::floor(q), f = q - floor;
    const glm::ivec3 cell(floor);
    const glm::vec3 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 share = glm::mix(1.0f - w, w, glm::vec3(at));
        sum += share.x * share.y * share.z * alongEdge(latticeHash(cell + at), f - glm::vec3(at));
    }
    return sum;
}

}  // namespace

void declareNoise(ParameterSet& parameters) {
    const NoiseSettings initial;
    parameters
        .real("noise", static_cast<double>(initial.amplitude), 0, 1, "",
              "noise that each puff carries along: largest relative change of its optical depth, whose mean is kept")
        .real("noise_scale", static_cast<double>(initial.cellRadii), 0.02, 10, "radii",
              "size of the noise's largest features, relative to the puff's radius");
}

NoiseSettings noiseSettings(const ParameterValues& values) {
    return {static_cast<float>(values.real("noise")), static_cast<float>(values.real("noise_scale"))};
}

NoisePlace noiseOf(std::uint64_t serial, float radiusMetres, const glm::vec3& fromCentre,
                   const NoiseSettings& settings) {
    const auto u = maths::uniform4(0, noiseStream, serial);
    const float metres = std::max(settings.cellRadii * radiusMetres, 1e-6f);
    return {fromCentre / metres + offsetCells * glm::vec3(u[0], u[1], u[2]), metres};
}

float plainNoise(const glm::vec3& q) {
    const float sum = 4 * gradientNoise(q) + 2 * gradientNoise(2.0f * q + 17.3f) + gradientNoise(4.0f * q + 41.7f);
    return std::clamp(2.2f / 7 * sum, -1.0f, 1.0f);
}

}  // namespace dustbench::draw
