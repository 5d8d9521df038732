#include "methods/kit/raycast/padded_cells.h"

#include <algorithm>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::raycast {

void PaddedCells::set(const glm::ivec3& cells, std::span<const float> values) {
    cells_ = cells;
    const glm::ivec3 size = cells + before + behind;
    values_.resize(static_cast<std::size_t>(slab()) * static_cast<std::size_t>(size.z));
    const std::size_t rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    parallel::forEachBlock(rows, 256, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            const int y = std::clamp(static_cast<int>(r) % size.y - before, 0, cells.y - 1);
            const int z = std::clamp(static_cast<int>(r) / size.y - before, 0, cells.z - 1);
            const std::size_t from =
                static_cast<std::size_t>(cells.x) *
                (static_cast<std::size_t>(y) + static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(z));
            const std::span<const float> row = values.subspan(from, static_cast<std::size_t>(cells.x));
            float* to = values_.data() + r * static_cast<std::size_t>(size.x);
            to = std::fill_n(to, before, row.front());
            to = std::ranges::copy(row, to).out;
            std::fill_n(to, behind, row.back());
        }
    });
}

}  // namespace dustbench::raycast
