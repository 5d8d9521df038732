// Maps the freshness of fire to emitted light and extinction.
//
// Both are linear between rows and constant beyond the first and the last. Light is that emitted by a thick cloud of
// this freshness, in linear RGB; it adds to the light that the cloud reflects. Source: Senger2009, ch. 3; Crane2007.
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

/// Reads `[[row]]` tables with `reaction`, `emission = [red, green, blue]` and `extinction`, or a table `[planck]`
/// (planck.h). Throws InputError with file and line.
[[nodiscard]] DUSTBENCH_API TransferFunction loadTransferFunction(const std::filesystem::path& file);

}  // namespace dustbench::raycast
