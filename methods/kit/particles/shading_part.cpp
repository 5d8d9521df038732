#include "methods/kit/particles/shading_part.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace dustbench::particles {
namespace {

struct Sum {
    glm::dvec3 colour{0};
    glm::dvec3 place{0};  ///< position, weighted by the luminosity
    double luminosity = 0;
};

/// α·size³
double glowWeight(const Puffs& puffs, std::size_t i) {
    const double size = puffs.radius[i];
    return static_cast<double>(puffs.opacity[i]) * size * size * size;
}

double glowLuminosity(const Puffs& puffs, std::size_t i) {
    const glm::dvec3 colour = puffs.colour(i);
    return (colour.r + colour.g + colour.b) * glowWeight(puffs, i);
}

/// The number s of emittedLights for each particle.
class Discriminant {
 public:
    Discriminant(const Puffs& puffs, GlowBy by) : puffs_(puffs), by_(by) {
        if (by == GlowBy::luminosity)
            for (std::size_t i = 0; i < puffs.size(); ++i) maximum_ = std::max(maximum_, glowLuminosity(puffs, i));
        if (by != GlowBy::place || puffs.empty()) return;
        for (const std::span<const float> column : {puffs.x, puffs.y, puffs.z}) {
            const auto [low, high] = std::ranges::minmax_element(column);
            if (!along_.empty() && *high - *low <= static_cast<float>(maximum_ - minimum_)) continue;
            along_ = column, minimum_ = *low, maximum_ = *high;
        }
    }
    [[nodiscard]] double operator()(std::size_t i) const {
        if (by_ == GlowBy::age) return static_cast<double>(puffs_.age[i]) / static_cast<double>(puffs_.lifetime[i]);
        const double value = by_ == GlowBy::place ? static_cast<double>(along_[i]) : glowLuminosity(puffs_, i);
        return maximum_ > minimum_ ? (value - minimum_) / (maximum_ - minimum_) : 0;
    }

 private:
    const Puffs& puffs_;
    GlowBy by_;
    std::span<const float> along_;
    double minimum_ = 0, maximum_ = 0;
};

}  // namespace

std::vector<EmittedLight> emittedLights(const Puffs& puffs, int parts, float perMetre, GlowBy by) {
    if (parts < 1) throw std::invalid_argument("emittedLights: `parts` must be 1 or more");
    std::vector<Sum> sums(static_cast<std::size_t>(parts));
    const Discriminant share(puffs, by);
    for (std::size_t i = 0; i < puffs.size(); ++i) {
        const glm::dvec3 colour = puffs.colour(i);
        const double weight = glowWeight(puffs, i), luminosity = glowLuminosity(puffs, i);
        Sum& sum = sums[static_cast<std::size_t>(std::clamp(static_cast<int>(share(i) * parts), 0, parts - 1))];
        sum.colour += weight * colour;
        sum.place += luminosity * glm::dvec3(puffs.position(i));
        sum.luminosity += luminosity;
    }
    std::vector<EmittedLight> lights;
    lights.reserve(sums.size());
    for (const Sum& sum : sums)
        lights.push_back({glm::vec3(static_cast<double>(perMetre) * sum.colour),
                          sum.luminosity > 0 ? glm::vec3(sum.place / sum.luminosity) : glm::vec3(0)});
    return lights;
}

}  // namespace dustbench::particles
