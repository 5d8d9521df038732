#include "methods/kit/octree/gpu/puff_upload.h"

#include <algorithm>
#include <array>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

constexpr std::size_t puffsPerBlock = 16'384, leastPuffs = 4096;

/// Fills the first `count` rows of `rowWords` words: `row(i, words)` writes one. A larger buffer replaces one that is
/// too small.
template <typename Word, typename Row>
void fillRows(gpu::Device& device, gpu::Buffer& buffer, std::size_t count, std::size_t rowWords, const Row& row) {
    const std::size_t bytes = count * rowWords * sizeof(Word);
    if (bytes > buffer.bytes() || buffer.bytes() == 0)
        buffer = gpu::Buffer(device, "uploaded puffs",
                             std::max({bytes, 2 * buffer.bytes(), leastPuffs * rowWords * sizeof(Word)}));
    if (count == 0) return;
    Word* const words = static_cast<Word*>(buffer.mapForWriting(bytes));
    parallel::forEachBlock(count, puffsPerBlock, [&](std::size_t first, std::size_t length) {
        for (std::size_t i = first; i < first + length; ++i) row(i, words + i * rowWords);
    });
    buffer.unmap();
}

}  // namespace

const GpuPuffs& PuffUpload::upload(const Puffs& dust) {
    const std::size_t count = dust.size();
    fillRows<float>(device_, position_, count, 3,
                    [&](std::size_t i, float* row) { row[0] = dust.x[i], row[1] = dust.y[i], row[2] = dust.z[i]; });
    fillRows<float>(device_, life_, count, 2,
                    [&](std::size_t i, float* row) { row[0] = dust.age[i], row[1] = dust.lifetime[i]; });
    fillRows<float>(device_, look_, count, 2,
                    [&](std::size_t i, float* row) { row[0] = dust.radius[i], row[1] = dust.opacity[i]; });
    fillRows<std::uint32_t>(device_, serial_, count, 2, [&](std::size_t i, std::uint32_t* row) {
        row[0] = static_cast<std::uint32_t>(dust.serial[i]), row[1] = static_cast<std::uint32_t>(dust.serial[i] >> 32);
    });
    if (!dust.uniformColour)
        fillRows<float>(device_, colour_, count, 3, [&](std::size_t i, float* row) {
            row[0] = dust.red[i], row[1] = dust.green[i], row[2] = dust.blue[i];
        });
    if (tally_.bytes() == 0) tally_ = gpu::Buffer(device_, "uploaded puffs", 4 * sizeof(std::uint32_t));
    const auto puffs = static_cast<std::uint32_t>(count);
    const std::array<std::uint32_t, 4> tally{puffs, (puffs + 255) / 256, 1, 1};
    tally_.write(std::span<const std::uint32_t>(tally));
    puffs_ = {.position = &position_,
              .life = &life_,
              .look = &look_,
              .serial = &serial_,
              .colour = dust.uniformColour ? nullptr : &colour_,
              .tally = &tally_,
              .bound = puffs,
              .colourOfAll = dust.colourOfAll};
    return puffs_;
}

std::size_t PuffUpload::bytes() const {
    return position_.bytes() + life_.bytes() + look_.bytes() + serial_.bytes() + colour_.bytes() + tally_.bytes();
}

}  // namespace dustbench::octree
