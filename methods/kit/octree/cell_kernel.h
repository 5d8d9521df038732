// Computes the cell and level of a particle; every builder uses it.
//
// Units: metres. Frame: world. Threads: pure.
// Source: Carr2006, 3.2 (older particles, larger voxels). Departs: the formulas are ours, because the paper gives none.
#pragma once

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "methods/contract/volume.h"
#include "methods/kit/octree/brick_nodes.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

/// √(π/2): a cube of edge edgePerRadius·r keeps the puff's τ, because edge² = 2π(r/2)².
inline constexpr float edgePerRadius = 1.2533141f;

/// Cell number of a coordinate, floor(x / edge), clamped to ±`furthest`. NaN maps to −`furthest`, outside any world.
[[nodiscard]] inline std::int32_t cellNumber(float metres, float cellsPerMetre, float furthest) {
    const float number = std::min(std::max(-furthest, metres * cellsPerMetre), furthest);
    return static_cast<std::int32_t>(std::floor(number));
}

/// Levels above the finest by age: min(L − 1, floor(L·age/lifetime)).
[[nodiscard]] inline std::uint32_t riseByAge(float age, float lifetime, float levels) {
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(std::min(std::max(0.0f, levels * age / lifetime), levels - 1)));
}

/// Divided by √2, because on a logarithmic scale the boundary between two edges is their geometric mean.
inline constexpr float edgesOfRadius = edgePerRadius / std::numbers::sqrt2_v<float>;

/// Levels above the finest by radius: the edge `finest·2^k` nearest to 1.253·r on a logarithmic scale, k below
/// `levels`.
[[nodiscard]] inline std::uint32_t riseByRadius(float radiusMetres, float finestEdgeMetres, std::uint32_t levels) {
    const float edges = edgesOfRadius * radiusMetres / finestEdgeMetres;
    std::uint32_t rise = 0;
    for (std::uint32_t step = 1; step < levels; ++step) rise += edges >= static_cast<float>(1u << (step - 1)) ? 1 : 0;
    return rise;
}

/// Moves bit k of a number below 2^8 to bit 3·k, in 32 bits.
[[nodiscard]] constexpr std::uint32_t spreadByte(std::uint32_t x) {
    x = (x | x << 8) & 0x0000f00fu;
    x = (x | x << 4) & 0x000c30c3u;
    x = (x | x << 2) & 0x00249249u;
    return x;
}

/// The cell of one particle. The Morton code is split into two halves, so that all fields have 32 bits and vectorise.
struct ParticleCell {
    std::uint32_t brickCode;    ///< of the brick, a cell of 16³ finest cells
    std::uint32_t localCode;    ///< of the finest cell within the brick, 12 bits
    std::uint32_t rise;         ///< of the particle's voxel above the finest cells
    std::uint32_t outside;      ///< all bits set if outside the world (other fields are then meaningless); else 0
    std::uint32_t aboveBricks;  ///< all bits set if the voxel is larger than a brick; else 0
};

#ifdef __AVX512F__
using Sixteen [[gnu::vector_size(64)]] = std::uint32_t;

/// The finest cells of sixteen particles, and the rise of their voxels.
struct SixteenCells {
    Sixteen x, y, z, rise;
    Sixteen outside;  ///< not 0 if outside the world; other fields are then meaningless
};
#endif

/// Maps particles of a store to cells of a lattice.
template <LevelRule rule>
class CellKernel {
 public:
    CellKernel(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings)
        : x_(store.x.data()),
          y_(store.y.data()),
          z_(store.z.data()),
          age_(store.age.data()),
          lifetime_(store.lifetime.data()),
          radius_(store.radius.data()),
          cellsPerMetre_(static_cast<float>(lattice.cellsPerEdge() / lattice.edgeMetres)),
          finestEdge_(static_cast<float>(lattice.cellEdgeMetres(lattice.depth))),
          firstX_(static_cast<std::uint32_t>(lattice.firstCell().x)),
          firstY_(static_cast<std::uint32_t>(lattice.firstCell().y)),
          firstZ_(static_cast<std::uint32_t>(lattice.firstCell().z)),
          cells_(lattice.cellsPerEdge()),
          levels_(static_cast<std::uint32_t>(settings.levels)) {}

    [[nodiscard]] ParticleCell operator()(std::size_t i) const {
        const auto [x, y, z] = finestCell(i);
        ParticleCell cell = belonging(i, x | y | z);
        cell.localCode = spread(x & 15, y & 15, z & 15);
        cell.brickCode = spread(x >> 4 & 255, y >> 4 & 255, z >> 4 & 255);
        return cell;
    }
#ifdef __AVX512F__
    /// The cells of particles `i` to `i` + 15.
    [[nodiscard]] SixteenCells sixteen(std::size_t i) const {
        SixteenCells cells{
            cellNumbers(x_ + i) - firstX_, cellNumbers(y_ + i) - firstY_, cellNumbers(z_ + i) - firstZ_, rises(i), {}};
        cells.outside = Sixteen((cells.x | cells.y | cells.z) >= cells_);
        return cells;
    }
#endif

 private:
    struct Cell {
        std::uint32_t x, y, z;
    };
    [[nodiscard]] Cell finestCell(std::size_t i) const {
        return {static_cast<std::uint32_t>(cellNumber(x_[i], cellsPerMetre_, furthest_)) - firstX_,
                static_cast<std::uint32_t>(cellNumber(y_[i], cellsPerMetre_, furthest_)) - firstY_,
                static_cast<std::uint32_t>(cellNumber(z_[i], cellsPerMetre_, furthest_)) - firstZ_};
    }
    /// All fields except the codes. `anyAxis`: bitwise or of the three cell numbers.
    [[nodiscard]] ParticleCell belonging(std::size_t i, std::uint32_t anyAxis) const {
        ParticleCell cell;
        cell.outside = -static_cast<std::uint32_t>(anyAxis >= cells_);
        if constexpr (rule == LevelRule::age)
            cell.rise = riseByAge(age_[i], lifetime_[i], static_cast<float>(levels_));
        else
            cell.rise = riseByRadius(radius_[i], finestEdge_, levels_);
        cell.aboveBricks = -static_cast<std::uint32_t>(cell.rise > std::uint32_t{brickRise});
        return cell;
    }
#ifdef __AVX512F__
    using Floats [[gnu::vector_size(64)]] = float;
    using Integers [[gnu::vector_size(64)]] = std::int32_t;

    [[nodiscard]] static Floats load(const float* from) {
        return Floats(_mm512_loadu_ps(from));
    }
    /// NaN and values out of range become the minimum integer.
    [[nodiscard]] Sixteen cellNumbers(const float* metres) const {
        const Floats numbers = load(metres) * cellsPerMetre_;
        return Sixteen(
            _mm512_maskz_cvt_roundps_epi32(0xffff, __m512(numbers), _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
    }
    [[nodiscard]] Sixteen rises(std::size_t i) const {
        if constexpr (rule == LevelRule::age) {
            const auto levels = static_cast<float>(levels_);
            const Floats rise = levels * load(age_ + i) / load(lifetime_ + i);
            const Floats minimum = Floats{} < rise ? rise : Floats{}, maximum = Floats{} + (levels - 1);
            return Sixteen(__builtin_convertvector(maximum < minimum ? maximum : minimum, Integers));
        } else {
            const Floats edges = edgesOfRadius * load(radius_ + i) / finestEdge_;
            Sixteen rise{};
            for (std::uint32_t step = 1; step < levels_; ++step)
                rise -= Sixteen(edges >= static_cast<float>(1u << (step - 1)));
            return rise;
        }
    }
#endif
    [[nodiscard]] static std::uint32_t spread(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        return spreadByte(x) << 2 | spreadByte(y) << 1 | spreadByte(z);
    }

    const float *x_, *y_, *z_, *age_, *lifetime_, *radius_;
    float cellsPerMetre_, finestEdge_;
    float furthest_ = 1e9f;  ///< not constant: with a constant GCC emits branches that cost a fifth of the whole kernel
    std::uint32_t firstX_, firstY_, firstZ_, cells_, levels_;
};

/// True if the particle's position has no NaN.
[[nodiscard]] bool isNumber(const Puffs& store, std::size_t particle);
/// `checkPositions` throws SimulationError with the serial of the first particle whose position is NaN. `checkCount`
/// throws InputError if there are more particles than a voxel can index. Builders check positions only if particles
/// are outside the world.
void checkPositions(const Puffs& store);
void checkCount(const Puffs& store);

}  // namespace dustbench::octree
