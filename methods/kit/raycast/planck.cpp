#include "methods/kit/raycast/planck.h"

#include <algorithm>
#include <cmath>

namespace dustbench::raycast {
namespace {

/// A Gaussian whose width differs on both sides; nanometres.
double lobe(double wavelength, double middle, double below, double above) {
    const double t = (wavelength - middle) / (wavelength < middle ? below : above);
    return std::exp(-0.5 * t * t);
}

/// The colour matching functions of Wyman2013, Eq. 4.
glm::dvec3 eyeResponse(double nm) {
    return {
        1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
        0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
        1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// B(λ, T) ∝ λ⁻⁵ / (exp(c₂/λT) − 1), relative to λ = 560 nm.
double spectralRadiance(double nm, double kelvin) {
    constexpr double c2 = 1.4387769e7;  // nm·K
    return std::pow(560 / nm, 5) / std::expm1(c2 / (nm * kelvin));
}

glm::dvec3 linearRgb(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

}  // namespace

glm::dvec3 blackBody(double kelvin) {
    glm::dvec3 sum(0);
    for (int nm = 360; nm <= 830; nm += 5) sum += spectralRadiance(nm, kelvin) * eyeResponse(nm);
    return sum;
}

TransferFunction transferFunctionOf(const PlanckFire& fire) {
    const double scale = fire.luminance / blackBody(fire.hotKelvin).y;
    std::vector<TransferFunction::Row> rows;
    for (int i = 0; i < TransferFunction::texels; ++i) {
        const double reaction = static_cast<double>(i) / (TransferFunction::texels - 1);
        const glm::dvec3 light = scale * linearRgb(blackBody(glm::mix(fire.coldKelvin, fire.hotKelvin, reaction)));
        rows.push_back({reaction, glm::vec3(glm::max(light, glm::dvec3(0))),
                        glm::mix(fire.burntExtinction, fire.freshExtinction, static_cast<float>(reaction))});
    }
    return TransferFunction(std::move(rows));
}

}  // namespace dustbench::raycast
