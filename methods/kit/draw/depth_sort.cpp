#include "methods/kit/draw/depth_sort.h"

#include <oneapi/tbb/task_arena.h>

#include <numeric>
#include <stdexcept>
#include <string>

#include "methods/kit/draw/depth_sort_key.h"
#include "methods/kit/draw/depth_sort_quicksort.h"
#include "methods/kit/draw/depth_sort_radix.h"

namespace dustbench::draw {
namespace {

/// With fewer points per block, a second thread costs more than it saves.
constexpr std::size_t pointsPerBlock = 50'000;

std::size_t blocksFor(std::size_t count) {
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    return std::clamp<std::size_t>(std::min(threads, count / pointsPerBlock), 1, radixMaximumBlocks);
}

/// |p − e|²: has the same order as the distance.
struct SquaredDistance {
    const float *x, *y, *z;
    float ex, ey, ez;

    float operator()(std::size_t i) const {
        const float dx = x[i] - ex, dy = y[i] - ey, dz = z[i] - ez;
        return dx * dx + dy * dy + dz * dz;
    }
};

struct GivenDepth {
    const float* depths;
    float operator()(std::size_t i) const { return depths[i]; }
};

/// Ensures a capacity of `count` elements plus an eighth, so that a slowly growing cloud does not allocate each frame.
template <typename T>
void hold(LedgerVector<T>& memory, std::size_t count) {
    if (memory.size() >= count) return;
    memory.clear();  // no contents to copy
    memory.reserve(count + count / 8);
    memory.resize(count + count / 8);
}

}  // namespace

DepthSort::DepthSort(MemoryLedger& ledger)
    : front_(ledger.account("depth sort")),
      back_(ledger.account("depth sort")),
      counts_(ledger.account("depth sort")),
      order_(ledger.account("depth sort")) {}

void DepthSort::grow(SortKind kind, std::size_t count) {
    hold(order_, count);
    if (kind != SortKind::none) hold(front_, count);
    if (kind == SortKind::radix) {
        hold(back_, count);
        hold(counts_, radixCounts);
    }
}

template <typename Depth>
std::span<const std::uint32_t> DepthSort::sort(SortKind kind, std::size_t count, const Depth& depth) {
    grow(kind, count);
    const auto order = std::span(order_).first(count);
    switch (kind) {
        case SortKind::none:
            std::iota(order.begin(), order.end(), 0u);
            break;
        case SortKind::quicksort: {
            const auto elements = std::span(front_).first(count);
            for (std::size_t i = 0; i < count; ++i) elements[i] = keyedIndex(farFirstKey(depth(i)), i);
            quicksort(elements);
            for (std::size_t i = 0; i < count; ++i) order[i] = indexOf(elements[i]);
            break;
        }
        case SortKind::radix: {
            RadixSort(std::span(front_).first(count), std::span(back_).first(count), order, counts_, blocksFor(count))
                .sort(depth);
            break;
        }
    }
    return order;
}

std::span<const std::uint32_t> DepthSort::farToNear(SortKind kind, const PointColumns& points, const glm::vec3& eye) {
    const std::size_t count = points.x.size();
    if (points.y.size() != count || points.z.size() != count)
        throw std::invalid_argument("depth sort: got columns of " + std::to_string(count) + ", " +
                                    std::to_string(points.y.size()) + " and " + std::to_string(points.z.size()) +
                                    " points, expected the same number");
    return sort(kind, count, SquaredDistance{points.x.data(), points.y.data(), points.z.data(), eye.x, eye.y, eye.z});
}

std::span<const std::uint32_t> DepthSort::farToNear(SortKind kind, std::span<const float> depths) {
    return sort(kind, depths.size(), GivenDepth{depths.data()});
}

}  // namespace dustbench::draw
