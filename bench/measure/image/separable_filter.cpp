#include "bench/measure/image/separable_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::measure {
namespace {

constexpr std::size_t rowsOfBlock = 16;

/// `work(y)` for every row.
template <typename Work>
void forEachRow(int height, const Work& work) {
    parallel::forEachBlock(static_cast<std::size_t>(height), rowsOfBlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t y = first; y < first + count; ++y) work(static_cast<int>(y));
    });
}

/// out += weight · in. The loop over the weights is outside: the inner loop runs along memory.
template <typename Number>
void addWeighted(Number weight, const Number* in, Number* out, int count) {
    for (int x = 0; x < count; ++x) out[x] += weight * in[x];
}

}  // namespace

template <typename Number>
PlaneOf<Number> filterRows(const PlaneOf<Number>& plane, std::span<const Number> kernel) {
    const int taps = static_cast<int>(kernel.size()), radius = taps / 2;
    PlaneOf<Number> result(plane.width, plane.height);
    forEachRow(plane.height, [&](int y) {
        std::vector<Number> padded(static_cast<std::size_t>(plane.width + 2 * radius));
        const Number* row = plane.row(y);
        for (int x = 0; x < plane.width + 2 * radius; ++x)
            padded[static_cast<std::size_t>(x)] = row[std::clamp(x - radius, 0, plane.width - 1)];
        for (int i = 0; i < taps; ++i)
            addWeighted(kernel[static_cast<std::size_t>(i)], padded.data() + i, result.row(y), plane.width);
    });
    return result;
}

template <typename Number>
PlaneOf<Number> filterColumns(const PlaneOf<Number>& plane, std::span<const Number> kernel) {
    const int taps = static_cast<int>(kernel.size()), radius = taps / 2;
    PlaneOf<Number> result(plane.width, plane.height);
    forEachRow(plane.height, [&](int y) {
        for (int i = 0; i < taps; ++i)
            addWeighted(kernel[static_cast<std::size_t>(i)], plane.row(std::clamp(y + i - radius, 0, plane.height - 1)),
                        result.row(y), plane.width);
    });
    return result;
}

template <typename Number>
std::vector<Number> gaussianKernel(double sigmaPixels, int radius) {
    std::vector<double> weights;
    for (int i = -radius; i <= radius; ++i) weights.push_back(std::exp(-0.5 * i * i / (sigmaPixels * sigmaPixels)));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<Number> kernel;
    kernel.reserve(weights.size());
    for (const double weight : weights) kernel.push_back(static_cast<Number>(weight / sum));
    return kernel;
}

template PlaneOf<float> filterRows(const PlaneOf<float>&, std::span<const float>);
template PlaneOf<float> filterColumns(const PlaneOf<float>&, std::span<const float>);
template std::vector<float> gaussianKernel<float>(double, int);
template PlaneOf<double> filterRows(const PlaneOf<double>&, std::span<const double>);
template PlaneOf<double> filterColumns(const PlaneOf<double>&, std::span<const double>);
template std::vector<double> gaussianKernel<double>(double, int);

}  // namespace dustbench::measure
