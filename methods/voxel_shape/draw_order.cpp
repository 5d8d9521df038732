#include "methods/voxel_shape/draw_order.h"

#include <algorithm>
#include <numeric>

namespace dustbench::voxel_shape {

DrawOrder::DrawOrder(MemoryLedger& ledger)
    : sort_(ledger),
      depths_(ledger.account("draw order")),
      chosenDepths_(ledger.account("draw order")),
      order_(ledger.account("draw order")),
      chosen_(ledger.account("draw order")) {}

std::span<const std::uint32_t> DrawOrder::of(const Look& look, const draw::PointColumns& points, const glm::vec3& eye) {
    switch (look.order) {
        case Order::radix:
            return sort_.farToNear(draw::SortKind::radix, points, eye);
        case Order::quicksort:
            return sort_.farToNear(draw::SortKind::quicksort, points, eye);
        case Order::nearest:
            return nearestSorted(look.nearest, points, eye);
        case Order::every:
            return sortedNowAndThen(look.every, points, eye);
        case Order::none:
            break;
    }
    return sort_.farToNear(draw::SortKind::none, points, eye);
}

std::span<const std::uint32_t> DrawOrder::nearestSorted(std::size_t nearest, const draw::PointColumns& points,
                                                        const glm::vec3& eye) {
    const std::size_t count = points.x.size();
    if (nearest >= count) return sort_.farToNear(draw::SortKind::radix, points, eye);
    depths_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 away = glm::vec3(points.x[i], points.y[i], points.z[i]) - eye;
        depths_[i] = glm::dot(away, away);
    }
    // The squared distance below which points belong to the nearest; points at exactly this distance do not.
    chosenDepths_.assign(depths_.begin(), depths_.end());
    const auto limit = chosenDepths_.begin() + static_cast<std::ptrdiff_t>(nearest);
    std::nth_element(chosenDepths_.begin(), limit, chosenDepths_.end());
    const float beyond = *limit;
    order_.clear();
    chosen_.clear();
    for (std::uint32_t i = 0; i < count; ++i) (depths_[i] < beyond ? chosen_ : order_).push_back(i);
    chosenDepths_.clear();
    for (const std::uint32_t i : chosen_) chosenDepths_.push_back(depths_[i]);
    for (const std::uint32_t k : sort_.farToNear(draw::SortKind::radix, std::span<const float>(chosenDepths_)))
        order_.push_back(chosen_[k]);
    return order_;
}

std::span<const std::uint32_t> DrawOrder::sortedNowAndThen(std::uint32_t every, const draw::PointColumns& points,
                                                           const glm::vec3& eye) {
    const std::size_t count = points.x.size();
    if (calls_++ % std::max(every, 1u) == 0) {
        const auto sorted = sort_.farToNear(draw::SortKind::radix, points, eye);
        order_.assign(sorted.begin(), sorted.end());
        return order_;
    }
    // Removed points leave the order and new ones are appended; a slot that was reused keeps its position.
    const std::size_t before = order_.size();
    if (count < before) {
        std::erase_if(order_, [&](std::uint32_t i) { return i >= count; });
    } else {
        order_.resize(count);
        std::iota(order_.begin() + static_cast<std::ptrdiff_t>(before), order_.end(),
                  static_cast<std::uint32_t>(before));
    }
    return order_;
}

}  // namespace dustbench::voxel_shape
