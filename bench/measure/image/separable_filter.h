// Separable filters: weighted sums along rows and along columns.
//
// Pixels beyond the edge repeat the edge pixel. Threads: uses the current oneTBB arena; the result is bit-identical at
// any number of threads.
#pragma once

#include <span>
#include <vector>

#include "bench/measure/image/picture.h"

namespace dustbench::measure {

/// out(x) = Σ kernel[r + i] · in(x + i) over i = −r..r; the kernel has 2r + 1 weights.
template <typename Number>
[[nodiscard]] PlaneOf<Number> filterRows(const PlaneOf<Number>& plane, std::span<const Number> kernel);
template <typename Number>
[[nodiscard]] PlaneOf<Number> filterColumns(const PlaneOf<Number>& plane, std::span<const Number> kernel);

/// exp(−i²/2σ²) at i = −radius..radius, summing to 1; σ in pixels.
template <typename Number>
[[nodiscard]] std::vector<Number> gaussianKernel(double sigmaPixels, int radius);

/// Filters rows, then columns.
template <typename Number>
[[nodiscard]] PlaneOf<Number> blur(const PlaneOf<Number>& plane, std::span<const Number> kernel) {
    return filterColumns(filterRows(plane, kernel), kernel);
}

}  // namespace dustbench::measure
