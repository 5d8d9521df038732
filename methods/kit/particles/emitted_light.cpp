#include "methods/kit/particles/emitted_light.h"

#include <algorithm>
#include <stdexcept>

namespace dustbench::particles {
namespace {

struct Sum {
    glm::dvec3 colour{0};
    glm::dvec3 place{0};  ///< position, weighted by the luminosity
    double luminosity = 0;
};

}  // namespace

std::vector<EmittedLight> emittedLights(const Puffs& puffs, int parts, float perMetre) {
    if (parts < 1) throw std::invalid_argument("emittedLights: `parts` must be 1 or more");
    std::vector<Sum> sums(static_cast<std::size_t>(parts));
    for (std::size_t i = 0; i < puffs.size(); ++i) {
        const glm::dvec3 colour = puffs.colour(i);
        const double size = puffs.radius[i], weight = static_cast<double>(puffs.opacity[i]) * size * size * size;
        const double luminosity = (colour.r + colour.g + colour.b) * weight;
        const double lived = static_cast<double>(puffs.age[i]) / static_cast<double>(puffs.lifetime[i]);
        Sum& sum = sums[static_cast<std::size_t>(std::clamp(static_cast<int>(lived * parts), 0, parts - 1))];
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
