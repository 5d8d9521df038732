#include "methods/volume/sparse/sparse_march.h"

#include "methods/kit/raycast/packet_march.h"
#include "methods/volume/sparse/nano_walk.h"

namespace dustbench::volume {
namespace {

using raycast::Floats, raycast::Four, raycast::FourInts, raycast::Ints, raycast::Places, raycast::RayPacket,
    raycast::Reach, raycast::laneCount;

struct alignas(64) Zeros {
    float values[brickCells] = {};
};
constexpr Zeros zeros;

glm::ivec3 firstThree(const FourInts& four) {
    return {four[0], four[1], four[2]};
}

/// The values of a tree near the last position: those of a brick and its seven upper neighbours.
class NearbyValues {
 public:
    explicit NearbyValues(const NanoTree& tree) : walk_(tree) {}

    [[nodiscard]] NanoWalk& walk() { return walk_; }

    [[gnu::always_inline]] void moveTo(const glm::ivec3& brick) {
        if (brick != brick_) move(brick);
    }
    /// The value of a cell in one of the eight bricks, relative to the first cell of the first brick.
    [[gnu::always_inline]] [[nodiscard]] float at(int x, int y, int z) const {
        return corners_[x >> 3 | y >> 3 << 1 | z >> 3 << 2][(x & 7) << 6 | (y & 7) << 3 | (z & 7)];
    }
    /// The same for four cells along z.
    [[gnu::always_inline]] [[nodiscard]] Four row(int x, int y, int z) const {
        const int corner = x >> 3 | y >> 3 << 1, row = (x & 7) << 6 | (y & 7) << 3;
        using lanes::Float8;
        using Int8 = int __attribute__((vector_size(32)));
        const Float8 low = lanes::load<Float8>(corners_[corner] + row),
                     high = lanes::load<Float8>(corners_[corner | 4] + row);
        const Float8 moved = lanes::lookUp(low, high, Int8{0, 1, 2, 3, 0, 0, 0, 0} + z);
        return __builtin_shufflevector(moved, moved, 0, 1, 2, 3);
    }
    /// The first brick's.
    [[gnu::always_inline]] [[nodiscard]] const float* first() const { return corners_[0]; }

 private:
    void move(const glm::ivec3& brick) {
        brick_ = brick;
        for (int n = 0; n < 8; ++n) {
            const float* const values = walk_.at(brick + glm::ivec3(n & 1, n >> 1 & 1, n >> 2)).values;
            corners_[n] = values ? values : zeros.values;
        }
    }

    NanoWalk walk_;
    glm::ivec3 brick_{1 << 30};
    const float* corners_[8];
};

struct Source {
    const SparseMoment& moment;
    float stepCells;
};

/// The samples of a packet's rays in a sparse grid.
class SparseProbe {
 public:
    SparseProbe(const Source& source, const RayPacket& rays)
        : moment_(source.moment),
          rays_(rays),
          step_(source.stepCells),
          last_{static_cast<float>(moment_.cells.x - 1), static_cast<float>(moment_.cells.y - 1),
                static_cast<float>(moment_.cells.z - 1), 0},
          first_{moment_.firstCell.x, moment_.firstCell.y, moment_.firstCell.z, 0},
          density_(moment_.density),
          reaction_(moment_.reaction) {}

    [[gnu::always_inline]] [[nodiscard]] Floats density(const Reach& reach) { return sample(density_, reach); }
    [[nodiscard]] Floats reaction(const Reach& reach) { return sample(reaction_, reach); }

    [[nodiscard]] int clearChunks(float begin, float nearest, float farthest) {
        const glm::ivec3 low = firstThree(cellBelow(rays_.low(nearest, farthest))),
                         high = firstThree(cellBelow(rays_.high(nearest, farthest)));
        const NanoWalk::Found found = density_.walk().at(low >> 3);
        if (const int edge = found.emptyEdge; edge > 0) {
            const glm::ivec3 apart = (low ^ high) & ~(edge - 1);
            if ((apart.x | apart.y | apart.z) == 0) return chunksWithin(low & ~(edge - 1), edge, begin);
        }
        const glm::ivec3 from = low >> 3, to = high >> 3;
        for (int x = from.x; x <= to.x; ++x)
            for (int y = from.y; y <= to.y; ++y)
                for (int z = from.z; z <= to.z; ++z)
                    if (isActive({x, y, z}, low, high)) return 0;
        return 1;
    }

 private:
    /// The lattice cell whose centre is the nearest below a position.
    [[gnu::always_inline]] [[nodiscard]] FourInts cellBelow(const Four& place) const {
        return __builtin_convertvector(raycast::atLeast(raycast::atMost(place - 0.5f, last_), Four{}), FourInts) +
               first_;
    }

    /// Whether any cell of a brick between `low` and `high` is active.
    [[nodiscard]] bool isActive(const glm::ivec3& brick, const glm::ivec3& low, const glm::ivec3& high) {
        const NanoWalk::Found found = density_.walk().at(brick);
        if (!found.active) return found.emptyEdge == 0;
        const glm::ivec3 first = brick * brickEdge;
        const glm::ivec3 from = glm::max(low - first, 0), to = glm::min(high - first, brickEdge - 1);
        const std::uint64_t alongZ = (0xffull >> (7 - to.z + from.z) << from.z) * 0x0101010101010101ull;
        const std::uint64_t rows = ~0ull >> (8 * (7 - to.y + from.y)) << (8 * from.y);
        std::uint64_t any = 0;
        for (int x = from.x; x <= to.x; ++x) any |= found.active[x];
        return (any & alongZ & rows) != 0;
    }

    /// Number of chunks from the step at `begin` on that are within an empty node; the first one is known to be.
    [[nodiscard]] int chunksWithin(const glm::ivec3& node, int edge, float begin) const {
        float leaves = std::numeric_limits<float>::max();
        for (int axis = 0; axis < 3; ++axis) {
            const float low = static_cast<float>(node[axis] - moment_.firstCell[axis]) + 0.5f;
            const float fastest = rays_.fastest[axis], slowest = rays_.slowest[axis], eye = rays_.eye[axis];
            if (fastest > 0) leaves = std::min(leaves, (low + static_cast<float>(edge) - eye) / fastest);
            if (slowest < 0) leaves = std::min(leaves, (low - eye) / slowest);
        }
        const float more = (leaves - begin - step_ * (raycast::stepsPerChunk + 1)) / (step_ * raycast::stepsPerChunk);
        return 1 + static_cast<int>(std::clamp(more, 0.0f, 1e6f));
    }

    [[gnu::always_inline]] [[nodiscard]] Floats sample(NearbyValues& values, const Reach& reach) {
        const Four low = rays_.low(reach.nearest, reach.farthest) - 0.5f,
                   high = rays_.high(reach.nearest, reach.farthest) - 0.5f;
        const FourInts base = __builtin_convertvector(raycast::atLeast(raycast::atMost(low, last_), Four{}), FourInts);
        const Four whole = __builtin_convertvector(base, Four);
        const glm::ivec3 cell = firstThree(base + first_), within = cell & 7;
        const Four most = raycast::atLeast(raycast::atMost(high, last_), Four{}) - whole;
        Places at = raycast::placesOf(rays_, reach.middle, whole, 1);
        // Clamps to the outermost cell centres; a ray that misses the box may be anywhere.
        for (int axis = 0; axis < 3; ++axis) {
            Floats& place = axis == 0 ? at.x : axis == 1 ? at.y : at.z;
            place = raycast::atLeast(raycast::atMost(place, raycast::all(most[axis])), Floats{});
        }
        if (raycast::CellWindow::useful && most[0] < 1.999f && most[1] < 2.999f && most[2] < 2.999f) {
            values.moveTo(cell >> 3);
            const Places turned{at.z, at.y, at.x};
            if (within.x <= 5 && within.y <= 4 && within.z <= 4)
                return raycast::CellWindow(values.first() + (within.x << 6 | within.y << 3 | within.z), 8, 64)
                    .sample(turned);
            return raycast::CellWindow([&](int k, int j) { return values.row(within.x + k, within.y + j, within.z); })
                .sample(turned);
        }
        // All corners of all lanes are in eight bricks.
        if (most[0] + static_cast<float>(within.x) < 14.999f && most[1] + static_cast<float>(within.y) < 14.999f &&
            most[2] + static_cast<float>(within.z) < 14.999f) {
            values.moveTo(cell >> 3);
            return lanewise(at,
                            [&](int x, int y, int z) { return values.at(within.x + x, within.y + y, within.z + z); });
        }
        return lanewise(at, [&](int x, int y, int z) {
            const glm::ivec3 there = cell + glm::ivec3(x, y, z);
            const float* const found = values.walk().at(there >> 3).values;
            return found ? found[(there.x & 7) << 6 | (there.y & 7) << 3 | (there.z & 7)] : 0.0f;
        });
    }

    /// Interpolates linearly between the eight neighbours of each lane; `value(x, y, z)` is the value of a cell.
    template <typename Value>
    [[nodiscard]] static Floats lanewise(const Places& at, const Value& value) {
        const Ints i = raycast::wholePart(at.x), j = raycast::wholePart(at.y), k = raycast::wholePart(at.z);
        const Places share{at.x - raycast::toFloats(i), at.y - raycast::toFloats(j), at.z - raycast::toFloats(k)};
        return raycast::betweenEight(share, [&](int corner) {
            Floats values;
            for (int lane = 0; lane < laneCount; ++lane)
                values[lane] = value(i[lane] + (corner & 1), j[lane] + (corner >> 1 & 1), k[lane] + (corner >> 2));
            return values;
        });
    }

    const SparseMoment& moment_;
    const RayPacket& rays_;
    float step_;
    Four last_;
    FourInts first_;
    NearbyValues density_, reaction_;
};

}  // namespace

SparseMarch::SparseMarch(const raycast::RaycastSettings& settings)
    : settings_(settings), fire_(settings.fire.table()) {}

void SparseMarch::set(const SparseMoment& moment, const raycast::LightVolume* light) {
    moment_ = &moment;
    light_ = light;
}

void SparseMarch::march(const raycast::PixelRays& rays, const raycast::SceneDepths& depths,
                        const raycast::Reflected& reflected, const raycast::PacketPicture& picture) const {
    const SparseMoment& moment = *moment_;
    raycast::Medium medium{moment.cells,
                           settings_.skipEmpty,
                           moment.minimum(),
                           moment.maximum(),
                           burning(),
                           std::nullopt,
                           fire_,
                           reflected,
                           static_cast<float>(settings_.stepCells),
                           static_cast<float>(settings_.extinctionPerMetre * moment.spacingMetres),
                           raycast::opaqueDepth(settings_)};
    if (light_) medium.light.emplace(light_->padded(), 1 / static_cast<float>(light_->texelCells()));
    const Source source{moment, medium.stepCells};
    if (channels() == 4)
        raycast::marchPackets<SparseProbe, true>(medium, source, rays, depths, settings_.jitter, picture);
    else
        raycast::marchPackets<SparseProbe, false>(medium, source, rays, depths, settings_.jitter, picture);
}

}  // namespace dustbench::volume
