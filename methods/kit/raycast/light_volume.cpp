#include "methods/kit/raycast/light_volume.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/raycast/cell_window.h"

namespace dustbench::raycast {
namespace {

constexpr float darkDepth = 8;  ///< at most 0.03 % of the light remains

}  // namespace

LightVolume::LightVolume(const RaycastSettings& settings, const glm::vec3& toSun, MemoryLedger& ledger)
    : texelCells_(settings.shadowCells),
      extinctionPerMetre_(settings.extinctionPerMetre),
      toSun_(glm::normalize(toSun)),
      fire_(settings.fire.table()),
      density_(ledger.account("ray cast light")),
      values_(ledger.account("ray cast light")),
      paddedDensity_(ledger.account("ray cast light")),
      light_(ledger.account("ray cast light")) {}

void LightVolume::set(const ShownGrid& grid, const std::function<float(const glm::dvec3&)>& arriving) {
    set(
        grid, [&](std::span<float>) { average(grid, texelsOf(grid.cells)); }, arriving);
}

void LightVolume::set(const ShownGrid& grid, const std::function<void(std::span<float>)>& average,
                      const std::function<float(const glm::dvec3&)>& arriving) {
    const glm::ivec3 texels = texelsOf(grid.cells);
    const auto rows = static_cast<std::size_t>(texels.y * texels.z);
    density_.resize(rows * static_cast<std::size_t>(texels.x));
    values_.resize(density_.size());
    average(density_);
    paddedDensity_.set(texels, density_);
    parallel::forEachBlock(rows, 4, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r)
            marchRow(grid, static_cast<int>(r) % texels.y, static_cast<int>(r) / texels.y);
    });
    if (arriving) dim(grid, arriving);
    light_.set(texels, values_);
}

/// Scales the light by `arriving`, evaluated at every fourth texel and interpolated linearly.
void LightVolume::dim(const ShownGrid& grid, const std::function<float(const glm::dvec3&)>& arriving) {
    constexpr int apart = 4;
    const glm::ivec3 texels = paddedDensity_.cells(), nodes = (texels - 1) / apart + 2;
    const auto index = [](const glm::ivec3& at, const glm::ivec3& size) {
        return static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
    };
    std::vector<float> found(index({0, 0, nodes.z}, nodes));
    parallel::forEachBlock(found.size(), 64, [&](std::size_t first, std::size_t count) {
        for (std::size_t n = first; n < first + count; ++n) {
            const int i = static_cast<int>(n);
            const glm::ivec3 node(i % nodes.x, i / nodes.x % nodes.y, i / nodes.x / nodes.y);
            // Not beyond the grid: otherwise the stretch between its end and the texel would be missing.
            const glm::dvec3 cell =
                glm::min((glm::dvec3(node * apart) + 0.5) * static_cast<double>(texelCells_), glm::dvec3(grid.cells));
            found[n] = arriving(grid.originMetres + grid.spacingMetres * cell);
        }
    });
    std::size_t t = 0;
    for (glm::ivec3 texel(0); texel.z < texels.z; ++texel.z)
        for (texel.y = 0; texel.y < texels.y; ++texel.y)
            for (texel.x = 0; texel.x < texels.x; ++texel.x, ++t) {
                const glm::ivec3 low = texel / apart;
                const glm::vec3 share = glm::vec3(texel - low * apart) / static_cast<float>(apart);
                float sum = 0;
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
                    const glm::vec3 weight = glm::mix(1.0f - share, share, glm::vec3(side));
                    sum += weight.x * weight.y * weight.z * found[index(low + side, nodes)];
                }
                values_[t] *= sum;
            }
}

/// Mean extinction of each texel's cells, expressed as an equivalent density of smoke.
void LightVolume::average(const ShownGrid& grid, const glm::ivec3& texels) {
    const auto lastTexel = static_cast<float>(fire_.size() - 1);
    const auto effective = [&](std::size_t cell) {
        if (grid.reaction.empty()) return grid.density[cell];
        const float reaction = std::clamp(grid.reaction[cell], 0.0f, 1.0f);
        return grid.density[cell] * fire_[static_cast<std::size_t>(std::lround(reaction * lastTexel))].a;
    };
    parallel::forEachBlock(density_.size(), 64, [&](std::size_t first, std::size_t count) {
        for (std::size_t t = first; t < first + count; ++t) {
            const int i = static_cast<int>(t);
            const glm::ivec3 from =
                texelCells_ * glm::ivec3(i % texels.x, i / texels.x % texels.y, i / texels.x / texels.y);
            const glm::ivec3 to = glm::min(from + texelCells_, grid.cells);
            float sum = 0;
            for (int z = from.z; z < to.z; ++z)
                for (int y = from.y; y < to.y; ++y)
                    for (int x = from.x; x < to.x; ++x)
                        sum += effective(static_cast<std::size_t>(x + grid.cells.x * (y + grid.cells.y * z)));
            const glm::ivec3 size = to - from;
            density_[t] = sum / static_cast<float>(size.x * size.y * size.z);
        }
    });
}

/// Marches sixteen texels at a time, in steps of a texel's edge from each texel's centre to the point where the ray to
/// the sun leaves the grid.
void LightVolume::marchRow(const ShownGrid& grid, int y, int z) {
    const glm::ivec3 texels = paddedDensity_.cells();
    const float perTexel = 1.0f / static_cast<float>(texelCells_);
    const glm::vec3 end = glm::vec3(grid.cells) * perTexel;
    const float extinction =
        static_cast<float>(extinctionPerMetre_ * grid.spacingMetres) * static_cast<float>(texelCells_);
    for (int x = 0; x < texels.x; x += laneCount) {
        Floats column;
        for (int lane = 0; lane < laneCount; ++lane) column[lane] = static_cast<float>(x + lane);
        // Centres of texels; for texels that extend beyond the grid, clamped to its end.
        const Floats from[3] = {atMost(column + 0.5f, all(end.x)), all(std::min(static_cast<float>(y) + 0.5f, end.y)),
                                all(std::min(static_cast<float>(z) + 0.5f, end.z))};
        Floats length = all(1e9f);
        for (int axis = 0; axis < 3; ++axis)
            if (toSun_[axis] != 0)
                length = atMost(length, ((toSun_[axis] > 0 ? end[axis] : 0.0f) - from[axis]) / toSun_[axis]);
        Floats depth{};
        const float longest = maximum(length);
        for (float begin = 0; begin < longest && minimum(depth) < darkDepth; begin += 1) {
            const Floats to = atMost(all(begin + 1), length), step = atLeast(to - begin, all(0));
            const Floats middle = begin + 0.5f * step;
            const Places at{from[0] + middle * toSun_.x - 0.5f, from[1] + middle * toSun_.y - 0.5f,
                            from[2] + middle * toSun_.z - 0.5f};
            depth += step * extinction * sampleAnywhere(paddedDensity_, at);
        }
        const Floats light = expMinus(depth);
        float* const to = values_.data() + static_cast<std::size_t>(x + texels.x * (y + texels.y * z));
        for (int lane = 0; lane < std::min(laneCount, texels.x - x); ++lane) to[lane] = light[lane];
    }
}

}  // namespace dustbench::raycast
