// Sorts translucent primitives from the farthest to the nearest, the order in which they are drawn.
//
// Units: any, the same for all points. Owns: its working memory (20 bytes per point), booked on a ledger and kept
// between calls. Threads: one caller at a time; `radix` uses the current oneTBB arena. The order does not depend on the
// number of threads. Source: Carr2006, 3.1 (quicksort, far to near).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/choices.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::draw {

enum class SortKind {
    quicksort,  ///< as in the paper
    radix,      ///< radix sort of the depth; linear in the number of points
    none,       ///< keeps the given order
};
inline constexpr Choices<SortKind> sortKinds{
    {"quicksort", SortKind::quicksort}, {"radix", SortKind::radix}, {"none", SortKind::none}};

/// Coordinates of points, one column per axis; all columns have the same length.
struct PointColumns {
    std::span<const float> x, y, z;
};

class DUSTBENCH_API DepthSort {
 public:
    explicit DepthSort(MemoryLedger& ledger);

    /// Indices of the points by decreasing distance from the eye; ties by ascending index. Valid until the next call.
    /// Points must be finite.
    std::span<const std::uint32_t> farToNear(SortKind kind, const PointColumns& points, const glm::vec3& eye);
    /// The same for given depths, largest first.
    std::span<const std::uint32_t> farToNear(SortKind kind, std::span<const float> depths);

 private:
    template <typename Depth>
    std::span<const std::uint32_t> sort(SortKind kind, std::size_t count, const Depth& depth);
    void grow(SortKind kind, std::size_t count);

    LedgerVector<std::uint64_t> front_, back_;  ///< key above, index below
    LedgerVector<std::uint32_t> counts_;
    LedgerVector<std::uint32_t> order_;
};

}  // namespace dustbench::draw
