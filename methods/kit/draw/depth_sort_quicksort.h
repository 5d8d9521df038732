// Quicksort of keyed indices, as the paper's renderer uses it.
//
// Source: Hoare1962; median of three and a final insertion sort: Sedgewick1978.
#pragma once

#include <cstdint>
#include <span>

namespace dustbench::draw {

/// Ascending, in place. Deterministic; O(n log n) in the worst case too.
void quicksort(std::span<std::uint64_t> values);

}  // namespace dustbench::draw
