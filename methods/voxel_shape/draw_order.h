// The order in which a shape's particles are blended: sorted fully, partly, every few frames, or not at all.
//
// Units: metres. Owns: its lists, on a ledger. Threads: one caller at a time; the order does not depend on the number
// of threads. Source: JuckelBeckhaus2007, 4.4 (`sometimes it is sufficient to just sort parts of the particles`).
#pragma once

#include "methods/kit/draw/depth_sort.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

class DrawOrder {
 public:
    explicit DrawOrder(MemoryLedger& ledger);

    /// Returns the indices of the points in blending order. Valid until the next call.
    std::span<const std::uint32_t> of(const Look& look, const draw::PointColumns& points, const glm::vec3& eye);

 private:
    std::span<const std::uint32_t> nearestSorted(std::size_t nearest, const draw::PointColumns& points,
                                                 const glm::vec3& eye);
    std::span<const std::uint32_t> sortedNowAndThen(std::uint32_t every, const draw::PointColumns& points,
                                                    const glm::vec3& eye);

    draw::DepthSort sort_;
    LedgerVector<float> depths_, chosenDepths_;
    LedgerVector<std::uint32_t> order_, chosen_;
    std::uint32_t calls_ = 0;
};

}  // namespace dustbench::voxel_shape
