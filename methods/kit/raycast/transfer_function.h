// Maps the freshness of fire to emitted light and extinction, by a table or by Planck's law.
//
// Both are linear between rows and constant beyond the first and the last. Light is that emitted by a thick cloud of
// this freshness, in linear RGB; it adds to the light that the cloud reflects.
// Source: Senger2009, ch. 3 and Fig. 3; Crane2007; Planck1901; Wyman2013 (the eye's response, as sums of Gaussians).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace dustbench::raycast {

class DUSTBENCH_API TransferFunction {
 public:
    struct Row {
        double reaction;         ///< 1 fresh … 0 burnt out
        glm::vec3 emission;      ///< linear RGB
        float extinctionFactor;  ///< relative to the smoke's extinction at the same density
    };
    /// Size of the lookup table for the shader and the CPU: texel i is at a reaction of i / (size − 1).
    static constexpr int texels = 256;

    /// A yellow flame that fades through orange and red, and thins the smoke where it burns.
    TransferFunction();
    /// Throws InputError if there are fewer than two rows, rows are not sorted, or a value is out of range.
    explicit TransferFunction(std::vector<Row> rows);

    /// Emission RGB and extinction factor.
    [[nodiscard]] glm::vec4 at(double reaction) const;
    [[nodiscard]] std::vector<glm::vec4> table() const;

 private:
    std::vector<Row> rows_;
};

/// CIE 1931 tristimulus values XYZ of a black body's spectral radiance, up to a constant factor.
[[nodiscard]] glm::dvec3 blackBody(double kelvin);

/// Freshness gives the temperature of a black body, which gives colour and luminance.
struct PlanckFire {
    double coldKelvin = 700;                            ///< at a reaction of 0
    double hotKelvin = 1800;                            ///< at a reaction of 1; linear in between
    double luminance = 3;                               ///< Rec. 709 luminance of a thick cloud at `hotKelvin`
    float burntExtinction = 1, freshExtinction = 0.4f;  ///< factors at a reaction of 0 and of 1
};

/// Channels outside of the colour space, as blue is below 1,900 K, are 0.
[[nodiscard]] TransferFunction transferFunctionOf(const PlanckFire& fire);

/// Reads `[[row]]` tables with `reaction`, `emission = [red, green, blue]` and `extinction`, or a table `[planck]`
/// (PlanckFire). Throws InputError with file and line.
[[nodiscard]] DUSTBENCH_API TransferFunction loadTransferFunction(const std::filesystem::path& file);

}  // namespace dustbench::raycast
