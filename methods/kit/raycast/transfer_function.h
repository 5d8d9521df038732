// What burning shows: light given off and extinction, by how fresh the fire is.
//
// Between rows both go linearly; beyond the first and the last they stay. Light is what a thick cloud of that freshness
// gives off, in linear RGB; it comes on top of what the cloud reflects. Source: Senger2009, ch. 3; Crane2007.
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
        float extinctionFactor;  ///< of the smoke's extinction at the same density
    };
    /// As the shader and the CPU look it up: texel i stands for a reaction of i / (size − 1).
    static constexpr int texels = 256;

    /// A yellow flame that goes out through orange and red, and thins the smoke where it burns.
    TransferFunction();
    /// Throws InputError where there are fewer than two rows, or they are not sorted, or a value is out of range.
    explicit TransferFunction(std::vector<Row> rows);

    /// Emission RGB and extinction factor.
    [[nodiscard]] glm::vec4 at(double reaction) const;
    [[nodiscard]] std::vector<glm::vec4> table() const;

 private:
    std::vector<Row> rows_;
};

/// Reads `[[row]]` tables with `reaction`, `emission = [red, green, blue]` and `extinction`. Throws InputError with
/// file and line.
[[nodiscard]] DUSTBENCH_API TransferFunction loadTransferFunction(const std::filesystem::path& file);

}  // namespace dustbench::raycast
