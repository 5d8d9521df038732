#include "methods/grid_fluid/dust_mass.h"

#include <algorithm>

#include "methods/contract/volume.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::grid_fluid {
namespace {

/// Mean of `value(i)` over a sufficient sample of the particles.
template <typename Value>
double sampledMean(const Puffs& dust, const Value& value) {
    constexpr std::size_t enough = 4096;
    const std::size_t stride = std::max<std::size_t>(1, dust.size() / enough);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < dust.size(); i += stride, ++count) sum += value(i);
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

double meanPuffMassSquareMetres(const Puffs& dust) {
    return sampledMean(dust, [&](std::size_t i) {
        return maths::puffMassSquareMetres(static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]));
    });
}

double meanLifetimeSeconds(const Puffs& dust) {
    return sampledMean(dust, [&](std::size_t i) { return static_cast<double>(dust.lifetime[i]); });
}

std::size_t bornWithin(const Puffs& dust, double stepSeconds) {
    const auto step = static_cast<float>(stepSeconds);
    std::size_t born = 0;
    for (const float age : dust.age) born += age < step ? 1u : 0u;
    return born;
}

}  // namespace dustbench::grid_fluid
