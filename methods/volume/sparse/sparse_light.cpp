#include "methods/volume/sparse/sparse_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/volume/sparse/nano_walk.h"

namespace dustbench::volume {

void meanDensities(const SparseMoment& moment, std::span<const glm::vec4> fire, int texelCells,
                   std::span<float> averages) {
    const glm::ivec3 texels = (moment.cells + texelCells - 1) / texelCells;
    const auto slab = static_cast<std::size_t>(texels.x) * static_cast<std::size_t>(texels.y);
    const NanoTree& tree = moment.density;
    std::ranges::fill(averages, 0.0f);
    // One slab of texels at a time, so that each is summed in a fixed order.
    parallel::forEachBlock(static_cast<std::size_t>(texels.z), 1, [&](std::size_t layer, std::size_t) {
        NanoWalk reactions(moment.reaction);
        const int low = static_cast<int>(layer) * texelCells, high = std::min(low + texelCells, moment.cells.z);
        for (std::size_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
            const glm::ivec3 first = tree.brickOf(leaf) * brickEdge - moment.firstCell;
            const int from = std::max(low - first.z, 0), to = std::min(high - first.z, brickEdge);
            if (from >= to) continue;
            const float* const values = tree.valuesOf(leaf);
            const float* const reaction = reactions.at(tree.brickOf(leaf)).values;
            for (int z = from; z < to; ++z)
                for (int y = 0; y < brickEdge; ++y)
                    for (int x = 0; x < brickEdge; ++x) {
                        const int i = x << 6 | y << 3 | z;
                        if (!(values[i] > 0)) continue;  // only cells in the box
                        float density = values[i];
                        if (!moment.reaction.empty()) {
                            const auto last = static_cast<float>(fire.size() - 1);
                            density *=
                                fire[static_cast<std::size_t>(std::lround((reaction ? reaction[i] : 0) * last))].a;
                        }
                        const glm::ivec3 texel = (first + glm::ivec3(x, y, z)) / texelCells;
                        averages[static_cast<std::size_t>(texel.x + texels.x * texel.y) + slab * layer] += density;
                    }
        }
        for (int y = 0; y < texels.y; ++y)
            for (int x = 0; x < texels.x; ++x) {
                const glm::ivec3 from = texelCells * glm::ivec3(x, y, static_cast<int>(layer));
                const glm::ivec3 size = glm::min(from + texelCells, moment.cells) - from;
                averages[static_cast<std::size_t>(x + texels.x * y) + slab * layer] /=
                    static_cast<float>(size.x * size.y * size.z);
            }
    });
}

void requireLightFits(const SparseMoment& moment, int texelCells, bool onGpu) {
    constexpr double mostTexels = static_cast<double>(files::limits::volumeCells) / 8;
    constexpr int textureEdge = 2048;  // guaranteed by OpenGL 4.5
    const glm::dvec3 texels(((moment.cells - 1) / texelCells + 1));
    if (const double count = texels.x * texels.y * texels.z; count > mostTexels)
        throw InputError(
            fmt::format("storage=sparse: the box has {:.4g} blocks of shadow_cells={} for its light, allowed: "
                        "{:.4g}; increase shadow_cells",
                        count, texelCells, mostTexels));
    if (const double edge = std::max({texels.x, texels.y, texels.z}); onGpu && edge > textureEdge)
        throw InputError(
            fmt::format("storage=sparse: the box has {} blocks of shadow_cells={} along an axis for its light, "
                        "allowed by OpenGL: {}; increase shadow_cells",
                        edge, texelCells, textureEdge));
}

}  // namespace dustbench::volume
