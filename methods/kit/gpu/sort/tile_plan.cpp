#include "methods/kit/gpu/sort/tile_plan.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "gpu_sort_shaders.h"
#include "methods/contract/errors.h"

namespace dustbench::gpu {
namespace {

constexpr std::uint32_t maximumGroups = 65535;
constexpr std::size_t planWords = 8, perTileAt = 2 * sizeof(std::uint32_t), perShareAt = 5 * sizeof(std::uint32_t);

}  // namespace

TilePlan::TilePlan(Device& device, std::uint32_t capacity, std::uint32_t tileElements)
    : device_(&device),
      capacity_(capacity),
      tileElements_(tileElements),
      plan_(device, "plan of tiles", planWords * sizeof(std::uint32_t)) {
    if (maximumTiles() > maximumGroups)
        throw InputError("gpu_sort: got " + std::to_string(capacity) + " elements, expected at most " +
                         std::to_string(std::uint64_t{maximumGroups} * tileElements));
}

void TilePlan::set(const ElementCount& count) {
    if (!count.buffer) {
        if (count.number > capacity_)
            throw std::out_of_range("got " + std::to_string(count.number) + " elements, expected at most " +
                                    std::to_string(capacity_));
        if (elements_ == count.number) return;
        elements_ = count.number;
        tiles_ = tilesOf(count.number);
        const std::array<std::uint32_t, planWords> words{
            count.number, *tiles_, *tiles_, 1, 1, std::min(*tiles_, maximumShares), 1, 1};
        plan_.write(std::span<const std::uint32_t>(words));
        return;
    }
    elements_.reset();
    tiles_.reset();
    if (!fromBuffer_) {
        fromBuffer_.emplace(*device_, "plan of tiles", std::initializer_list<ShaderFile>{gpu_sort_shaders::plan_comp});
        fromBuffer_->set("capacity", static_cast<int>(capacity_));
        fromBuffer_->set("tileElements", static_cast<int>(tileElements_));
        fromBuffer_->set("maximumShares", static_cast<int>(maximumShares));
    }
    fromBuffer_->set("word", static_cast<int>(count.word));
    bind();
    count.buffer->bindStorage(1);
    fromBuffer_->dispatch(1, 1, 1);
}

void TilePlan::runPerTile(const Program& program) const {
    if (!tiles_)
        program.dispatchIndirect(plan_, perTileAt);
    else if (*tiles_ > 0)
        program.dispatch(static_cast<int>(*tiles_), 1, 1);
}

void TilePlan::runPerShare(const Program& program) const {
    if (!tiles_)
        program.dispatchIndirect(plan_, perShareAt);
    else if (*tiles_ > 0)
        program.dispatch(static_cast<int>(std::min(*tiles_, maximumShares)), 1, 1);
}

}  // namespace dustbench::gpu
