#include "methods/relief/ageing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dustbench::relief {
namespace {

constexpr double depthOverRadius = 0.25;
constexpr double smallestRadiusTexels = 1.5;

std::uint32_t stepsOf(double share) {
    return static_cast<std::uint32_t>(std::llround(std::clamp(share, 0.0, 1.0) * DepthMap::bottom));
}

/// V = ½·π·r²·h with h = r/4.
double radiusOf(double volume) {
    return std::cbrt(2 * volume / (std::numbers::pi * depthOverRadius));
}

}  // namespace

double volumeCubicMetres(const SurfaceHit& hit, const AgeingSettings& settings) {
    if (settings.model == AgeingModel::deposit) return settings.massKilograms / settings.densityKilogramsPerCubicMetre;
    const double inwards = std::max(0.0, -static_cast<double>(glm::dot(hit.velocity, hit.normal)));  // v·sin α
    return 0.5 * settings.massKilograms * inwards * inwards / settings.hardnessJoulesPerCubicMetre;
}

Impact impactOf(const SurfaceHit& hit, const AgeingSettings& settings, const TexelFrame& texels, double depthMetres) {
    if (settings.model == AgeingModel::paper) return {hit.texels.x, hit.texels.y, 0, DepthMap::bottom};
    if (settings.model == AgeingModel::scalar) return {hit.texels.x, hit.texels.y, 0, stepsOf(settings.scalar)};
    const double volume = volumeCubicMetres(hit, settings);
    const double texelMetres = std::sqrt(texels.texelAreaSquareMetres());
    const double radius = std::max(radiusOf(volume), smallestRadiusTexels * texelMetres);
    const double height = 2 * volume / (std::numbers::pi * radius * radius);
    return {hit.texels.x, hit.texels.y, static_cast<float>(radius / texelMetres), stepsOf(height / depthMetres)};
}

std::optional<Repose> reposeOf(const AgeingSettings& settings, const scene::Panel& panel) {
    if (settings.model != AgeingModel::deposit || settings.reposeDegrees >= 90) return std::nullopt;
    return Repose{std::tan(settings.reposeDegrees * std::numbers::pi / 180),
                  panel.sizeMetres / glm::dvec2(panel.relief->columns, panel.relief->rows), panel.depthMetres};
}

}  // namespace dustbench::relief
