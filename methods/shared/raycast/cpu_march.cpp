#include "methods/shared/raycast/cpu_march.h"

#include <cmath>

#include "methods/shared/parallel/for_each_block.h"
#include "methods/shared/raycast/cell_window.h"
#include "methods/shared/raycast/ray_packet.h"

namespace dustbench::raycast {
namespace {

constexpr std::size_t packetsPerBlock = 64;
/// Steps that are skipped, or not, together.
constexpr int stepsPerChunk = 8;

/// Eight linear samples make a cubic B-spline's 64: along each axis the two outer pairs of weights are put together.
/// Source: Sigg2005.
struct CubicPairs {
    explicit CubicPairs(const Floats& place) {
        const Floats low = toFloats(wholePart(place + 1)) - 1;  // places are −½ or more
        const Floats share = place - low, rest = 1 - share;
        const Floats w0 = rest * rest * rest * (1.0f / 6), w3 = share * share * share * (1.0f / 6);
        const Floats w1 = 2.0f / 3 - 0.5f * share * share * (2 - share), w2 = 1 - w0 - w1 - w3;
        weightBelow = w0 + w1;
        below = low - 1 + w1 / weightBelow;
        above = low + 1 + w3 / (w2 + w3);
    }
    Floats weightBelow, below, above;
};

Floats sampleCubic(const PaddedCells& cells, const Places& at) {
    const CubicPairs x(at.x), y(at.y), z(at.z);
    const Places above{1 - x.weightBelow, 1 - y.weightBelow, 1 - z.weightBelow};
    return betweenEight(above, [&](int corner) {
        return sampleAnywhere(
            cells, {corner & 1 ? x.above : x.below, corner & 2 ? y.above : y.below, corner & 4 ? z.above : z.below});
    });
}

/// Whether one of the bricks that a box of cells meets is occupied.
bool anyOccupied(const BrickMap& bricks, const glm::vec3& low, const glm::vec3& high) {
    constexpr float perCell = 1.0f / BrickMap::edge;
    const glm::ivec3 first = glm::clamp(glm::ivec3(low * perCell), glm::ivec3(0), bricks.bricks() - 1);
    const glm::ivec3 last = glm::clamp(glm::ivec3(high * perCell), glm::ivec3(0), bricks.bricks() - 1);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x)
                if (bricks.at(x, y, z)) return true;
    return false;
}

/// Distances along the camera's axis to distances along the rays of a packet.
Floats sceneDistance(const PixelRays& rays, const SceneDepths& depths, int x, int y, const Floats& stretch) {
    Floats depth;
    for (int lane = 0; lane < laneCount; ++lane) {
        const int column = std::min(x + lane % 4, depths.width - 1), row = std::min(y + lane / 4, depths.height - 1);
        depth[lane] = depths.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(depths.width) +
                                    static_cast<std::size_t>(column)];
    }
    return rays.nearDistance / atLeast(depth, all(1e-9f)) * stretch;
}

/// What a march goes through and looks for.
struct Volume {
    const PaddedCells& density;
    const PaddedCells& reaction;  ///< where it burns
    const BrickMap* bricks;       ///< null: nothing is skipped
    std::span<const glm::vec4> fire;
    glm::vec3 reflected;
    float stepCells, extinctionPerCell, opaqueDepth;
};

/// One packet's way through a volume.
template <bool burning, bool cubic>
class PacketMarch {
 public:
    PacketMarch(const Volume& volume, const RayPacket& rays, const Floats& jitter, const Floats& sceneDistance)
        : volume_(volume), rays_(rays), step_(volume.stepCells), shift_(jitter * volume.stepCells) {
        const glm::vec3 cells(volume.density.cells());
        const Stretches box = rays.within(glm::vec3(0), cells);
        Stretches filled = box;
        if (volume.bricks) filled = rays.within(glm::vec3(volume.bricks->least()), glm::vec3(volume.bricks->most()));
        filled.to = atMost(filled.to, sceneDistance);
        const Ints hits = filled.from < filled.to;
        // What misses has no length.
        from_ = box.from;
        end_ = hits ? atMost(box.to, sceneDistance) : from_;
        lastFrom_ = most(from_);
        firstEnd_ = least(end_);
        first_ = least(hits ? filled.from : all(std::numeric_limits<float>::max()));
        last_ = most(hits ? filled.to : all(0));
    }

    [[gnu::always_inline]] void march() {
        for (int k = static_cast<int>(std::floor(first_ / step_)) - 1; step_ * static_cast<float>(k) < last_;
             k += stepsPerChunk) {
            const float begin = step_ * static_cast<float>(k), end = begin + step_ * (stepsPerChunk + 1);
            if (volume_.bricks) {
                glm::vec3 low, high;
                rays_.bounds(std::max(begin, first_), std::min(end, last_), low, high);
                if (!anyOccupied(*volume_.bricks, low, high)) continue;
            }
            const bool uncut = lastFrom_ <= begin && end <= firstEnd_;
            for (int i = 0; i < stepsPerChunk; ++i) step(step_ * static_cast<float>(k + i), uncut);
            if (least(depth_) > volume_.opaqueDepth) break;
        }
    }

    [[nodiscard]] Floats alpha() const { return 1 - expMinus(depth_); }
    [[nodiscard]] const Floats& colour(int channel) const { return colour_[channel]; }

 private:
    /// The step of each ray that begins at `begin` and its jitter.
    [[gnu::always_inline]] void step(float begin, bool uncut) {
        const Floats from = atLeast(begin + shift_, from_), to = atMost(begin + shift_ + step_, end_);
        const Floats middle = 0.5f * (from + to);
        const Floats length = depth_ > volume_.opaqueDepth ? all(0) : atLeast(to - from, all(0));
        if constexpr (cubic) {
            const Places at = places(middle, glm::vec3(0.5f));
            gather(length, sampleCubic(volume_.density, at), [&] { return sampleCubic(volume_.reaction, at); });
            return;
        }
        // The middles of steps that are cut may lie anywhere in them.
        glm::vec3 low, high;
        rays_.bounds(begin + (uncut ? 0.5f : 0.0f) * step_, begin + (uncut ? 1.5f : 2.0f) * step_, low, high);
        const glm::ivec3 cells = volume_.density.cells();
        const glm::ivec3 base = glm::clamp(glm::ivec3(glm::floor(low - 0.5f)), glm::ivec3(-1), cells - 1);
        const glm::vec3 reach = glm::min(high, glm::vec3(cells)) - 0.5f - glm::vec3(base);
        constexpr float rounding = 1e-3f;
        if (CellWindow::useful && reach.x < 3 - rounding && reach.y < 3 - rounding && reach.z < 2 - rounding) {
            const Places at = places(middle, glm::vec3(base) + 0.5f);
            gather(length, CellWindow(volume_.density, base).sample(at),
                   [&] { return CellWindow(volume_.reaction, base).sample(at); });
        } else {
            const Places at = places(middle, glm::vec3(0.5f));
            gather(length, sampleAnywhere(volume_.density, at), [&] { return sampleAnywhere(volume_.reaction, at); });
        }
    }

    [[gnu::always_inline]] [[nodiscard]] Places places(const Floats& distance, const glm::vec3& origin) const {
        return {rays_.eye.x - origin.x + distance * rays_.along[0], rays_.eye.y - origin.y + distance * rays_.along[1],
                rays_.eye.z - origin.z + distance * rays_.along[2]};
    }

    /// D ← D + σ·Δ,   C ← C + (T before − T after)·(reflected + emission)
    template <typename Reaction>
    [[gnu::always_inline]] void gather(const Floats& length, const Floats& density, const Reaction& reaction) {
        const Floats depth = length * density * volume_.extinctionPerCell;
        if constexpr (burning) {
            const Burning look = burningAt(reaction());
            depth_ += depth * look.extinction;
            const Floats left = expMinus(depth_), share = transmittance_ - left;
            for (int channel = 0; channel < 3; ++channel)
                colour_[channel] += share * (volume_.reflected[channel] + look.emission[channel]);
            transmittance_ = left;
        } else {
            depth_ += depth;
        }
    }

    struct Burning {
        Floats emission[3], extinction;
    };
    [[nodiscard]] Burning burningAt(const Floats& reaction) const {
        const std::span<const glm::vec4> fire = volume_.fire;
        const Floats at = atLeast(atMost(reaction, all(1)), all(0)) * static_cast<float>(fire.size() - 1);
        const Ints texel = wholePart(at);
        Burning result;
        for (int lane = 0; lane < laneCount; ++lane) {
            const auto i = static_cast<std::size_t>(texel[lane]);
            const float share = at[lane] - static_cast<float>(texel[lane]);
            const glm::vec4 value = glm::mix(fire[i], fire[std::min(i + 1, fire.size() - 1)], share);
            for (int channel = 0; channel < 3; ++channel) result.emission[channel][lane] = value[channel];
            result.extinction[lane] = value.a;
        }
        return result;
    }

    const Volume& volume_;
    const RayPacket& rays_;
    float step_;
    Floats shift_;
    Floats from_, end_;          ///< of each ray, within the grid and before the scene
    float lastFrom_, firstEnd_;  ///< between them no ray is cut
    float first_, last_;         ///< between them is all there may be to see
    Floats depth_{};
    Floats transmittance_ = all(1);
    Floats colour_[3]{};
};

template <bool burning, bool cubic>
void marchAll(const Volume& volume, const PixelRays& rays, const SceneDepths& depths, bool jitter,
              const PacketPicture& picture) {
    parallel::forEachBlock(picture.packets(), packetsPerBlock, [&](std::size_t first, std::size_t count) {
        const auto across = static_cast<std::size_t>(picture.packetsAcross());
        for (std::size_t p = first; p < first + count; ++p) {
            const int x = picture.rectangle.left + PacketPicture::edge * static_cast<int>(p % across);
            const int y = picture.rectangle.bottom + PacketPicture::edge * static_cast<int>(p / across);
            const RayPacket packet(rays, x, y);
            PacketMarch<burning, cubic> march(volume, packet, jitter ? packet.jitter : Floats{},
                                              sceneDistance(rays, depths, x, y, packet.stretch));
            march.march();
            float* to = picture.values.data() + p * PacketPicture::pixels * static_cast<std::size_t>(picture.channels);
            if constexpr (burning)
                for (int channel = 0; channel < 3; ++channel, to += laneCount)
                    std::memcpy(to, &march.colour(channel), sizeof(Floats));
            const Floats alpha = march.alpha();
            std::memcpy(to, &alpha, sizeof alpha);
        }
    });
}

}  // namespace

CpuMarch::CpuMarch(const RaycastSettings& settings, MemoryLedger& ledger)
    : settings_(settings),
      fire_(settings.fire.table()),
      density_(ledger.account("ray cast density")),
      reaction_(ledger.account("ray cast reaction")) {}

void CpuMarch::upload(const ShownGrid& grid, const BrickMap& bricks) {
    density_.set(grid.cells, grid.density);
    burning_ = !grid.reaction.empty();
    if (burning_) reaction_.set(grid.cells, grid.reaction);
    extinctionPerCell_ = static_cast<float>(settings_.extinctionPerMetre * grid.spacingMetres);
    bricks_ = &bricks;
}

void CpuMarch::march(const PixelRays& rays, const SceneDepths& depths, const glm::vec3& reflected,
                     const PacketPicture& picture) const {
    const Volume volume{density_,
                        reaction_,
                        settings_.skipEmpty ? bricks_ : nullptr,
                        fire_,
                        reflected,
                        static_cast<float>(settings_.stepCells),
                        extinctionPerCell_,
                        opaqueDepth(settings_)};
    const bool cubic = settings_.filter == Filter::cubic;
    const auto all = burning_ ? (cubic ? marchAll<true, true> : marchAll<true, false>)
                              : (cubic ? marchAll<false, true> : marchAll<false, false>);
    all(volume, rays, depths, settings_.jitter, picture);
}

}  // namespace dustbench::raycast
