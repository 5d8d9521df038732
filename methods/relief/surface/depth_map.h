// The depths of a relief in fixed point, for collision, ageing and drawing.
//
//     D(u, v) = bilinear interpolation of the texels' depths, clamped at the rim
//
// Units: u and v in texels, texel (i, j) at (i, j), the face from −½ to columns − ½; depths as a share of the panel's
// depth, 0 at the face and 1 at the bottom, in steps of 2⁻³⁰. Integers make sums exact in any order.
// Owns: its columns, booked on a ledger. Threads: any thread may read; one writer.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::relief {

class DepthMap {
 public:
    static constexpr std::uint32_t bottom = 1u << 30;

    DepthMap(const scene::Relief& relief, MemoryLedger& ledger);

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] std::size_t size() const { return depths_.size(); }
    [[nodiscard]] std::size_t texel(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }
    /// Row by row from the lowest, each at most `bottom`.
    [[nodiscard]] std::span<const std::uint32_t> depths() const { return depths_; }
    [[nodiscard]] std::span<std::uint32_t> depths() { return depths_; }

    /// Returns the depth of a texel; outside the map, that of the nearest texel.
    [[nodiscard]] double at(int column, int row) const;
    /// D(u, v).
    [[nodiscard]] double depthAt(double u, double v) const;
    /// (∂D/∂u, ∂D/∂v), within the patch that contains (u, v).
    [[nodiscard]] glm::dvec2 slopeAt(double u, double v) const;

 private:
    int columns_, rows_;
    LedgerVector<std::uint32_t> depths_;
};

}  // namespace dustbench::relief
