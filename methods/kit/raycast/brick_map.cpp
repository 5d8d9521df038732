#include "methods/kit/raycast/brick_map.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::raycast {
namespace {

constexpr std::size_t rowsPerBlock = 256;

[[noreturn]] void refuse(const ShownGrid& grid) {
    for (std::size_t i = 0; i < grid.density.size(); ++i) {
        if (grid.density[i] >= 0 && grid.density[i] <= std::numeric_limits<float>::max()) continue;
        const std::size_t nx = static_cast<std::size_t>(grid.cells.x), ny = static_cast<std::size_t>(grid.cells.y);
        std::ostringstream text;
        text << "shown grid: got a density of " << grid.density[i] << " in cell (" << i % nx << ", " << i / nx % ny
             << ", " << i / nx / ny << "), allowed: 0 or more";
        throw InputError(text.str());
    }
    throw std::logic_error("brick map: an allowed value was refused");
}

}  // namespace

BrickMap::BrickMap(MemoryLedger& ledger)
    : occupied_(ledger.account("ray cast bricks")), rowMaximum_(ledger.account("ray cast bricks")) {}

void BrickMap::set(const ShownGrid& grid, int reach) {
    bricks_ = (grid.cells + edge - 1) / edge;
    const int nx = grid.cells.x, ny = grid.cells.y;
    const std::size_t along = static_cast<std::size_t>(bricks_.x), rows = static_cast<std::size_t>(ny * grid.cells.z);
    rowMaximum_.resize(rows * along);

    // Maximum over each brick's part of a row, including neighbours within reach. NaN and negative values count as
    // infinite.
    parallel::forEachBlock(rows, rowsPerBlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            const float* const row = grid.density.data() + r * static_cast<std::size_t>(nx);
            for (int b = 0; b < bricks_.x; ++b) {
                const int from = std::max(b * edge - reach, 0), to = std::min((b + 1) * edge + reach, nx);
                float maximum = 0;
                for (int i = from; i < to; ++i) {
                    const float value = row[i] >= 0 ? row[i] : std::numeric_limits<float>::infinity();
                    maximum = value > maximum ? value : maximum;
                }
                rowMaximum_[r * along + static_cast<std::size_t>(b)] = maximum;
            }
        }
    });
    float highest = 0;
    for (const float value : rowMaximum_) highest = std::max(highest, value);
    if (highest > std::numeric_limits<float>::max()) {
        bricks_ = minimum_ = maximum_ = glm::ivec3(0);
        refuse(grid);
    }

    occupied_.assign(along * static_cast<std::size_t>(bricks_.y * bricks_.z), 0);
    for (int z = 0; z < bricks_.z; ++z)
        for (int y = 0; y < bricks_.y; ++y) {
            std::uint8_t* const brick = occupied_.data() + index(0, y, z);
            for (int k = std::max(z * edge - reach, 0); k < std::min((z + 1) * edge + reach, grid.cells.z); ++k)
                for (int j = std::max(y * edge - reach, 0); j < std::min((y + 1) * edge + reach, ny); ++j) {
                    const float* const row = rowMaximum_.data() + static_cast<std::size_t>(j + ny * k) * along;
                    for (std::size_t b = 0; b < along; ++b) brick[b] |= row[b] > 0 ? 255 : 0;
                }
        }
    findBounds(grid.cells);
}

void BrickMap::findBounds(const glm::ivec3& cells) {
    glm::ivec3 minimum = bricks_, maximum(0);
    for (int z = 0; z < bricks_.z; ++z)
        for (int y = 0; y < bricks_.y; ++y)
            for (int x = 0; x < bricks_.x; ++x)
                if (at(x, y, z)) {
                    minimum = glm::min(minimum, glm::ivec3(x, y, z));
                    maximum = glm::max(maximum, glm::ivec3(x, y, z) + 1);
                }
    minimum_ = minimum * edge;
    maximum_ = glm::min(maximum * edge, cells);
}

}  // namespace dustbench::raycast
