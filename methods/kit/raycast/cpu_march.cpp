#include "methods/kit/raycast/cpu_march.h"

#include <cmath>
#include <optional>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/raycast/cell_window.h"
#include "methods/kit/raycast/ray_packet.h"

namespace dustbench::raycast {
namespace {

constexpr std::size_t packetsPerBlock = 64;
/// Steps that are skipped as a unit.
constexpr int stepsPerChunk = 4;

/// Evaluates a cubic B-spline with eight linear samples instead of 64 cells, by merging the weights along each axis
/// into two pairs. Source: Sigg2005.
struct CubicPairs {
    explicit CubicPairs(const Floats& place) {
        const Floats low = toFloats(wholePart(place + 1)) - 1;  // positions are −½ or more
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

/// Whether any brick that a box of cells touches is occupied.
bool anyOccupied(const BrickMap& bricks, const Four& low, const Four& high) {
    constexpr float perCell = 1.0f / BrickMap::edge;
    const FourInts none{}, end{bricks.bricks().x - 1, bricks.bricks().y - 1, bricks.bricks().z - 1, 0};
    const FourInts first = atLeast(atMost(__builtin_convertvector(low * perCell, FourInts), end), none);
    const FourInts last = atLeast(atMost(__builtin_convertvector(high * perCell, FourInts), end), none);
    for (int z = first[2]; z <= last[2]; ++z)
        for (int y = first[1]; y <= last[1]; ++y)
            for (int x = first[0]; x <= last[0]; ++x)
                if (bricks.at(x, y, z)) return true;
    return false;
}

/// Converts the scene's depths to distances along the rays of a packet.
Floats sceneDistance(const PixelRays& rays, const SceneDepths& depths, int x, int y, const Floats& stretch) {
    Floats depth;
    for (int lane = 0; lane < laneCount; ++lane) {
        const int column = std::min(x + lane % 4, depths.width - 1), row = std::min(y + lane / 4, depths.height - 1);
        depth[lane] = depths.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(depths.width) +
                                    static_cast<std::size_t>(column)];
    }
    return rays.nearDistance / atLeast(depth, all(1e-9f)) * stretch;
}

/// A grid to sample, with the number of its cells per cell of the shown grid.
struct Field {
    explicit Field(const PaddedCells& padded, float scale = 1)
        : cells(padded),
          origin(padded.origin()),
          row(padded.row()),
          slab(padded.slab()),
          last{static_cast<float>(padded.cells().x - 1), static_cast<float>(padded.cells().y - 1),
               static_cast<float>(padded.cells().z - 1), 0},
          perCell(scale) {}

    const PaddedCells& cells;
    const float* origin;
    std::ptrdiff_t row, slab;
    Four last;  ///< middle of the last cell
    float perCell;
};

/// Inputs of a ray march.
struct Volume {
    Field density;
    std::optional<Field> reaction;  ///< empty: no fire
    std::optional<Field> light;     ///< empty: no shadow
    const BrickMap* bricks;         ///< null: no skipping
    std::span<const glm::vec4> fire;
    Reflected reflected;
    float stepCells, extinctionPerCell, opaqueDepth;
};

/// Marches one packet through a volume.
template <bool coloured, bool cubic>
class PacketMarch {
 public:
    PacketMarch(const Volume& volume, const RayPacket& rays, const Floats& jitter, const Floats& sceneDistance)
        : volume_(volume),
          rays_(rays),
          step_(volume.stepCells),
          opaque_(volume.opaqueDepth / volume.extinctionPerCell),
          shift_(jitter * volume.stepCells) {
        if constexpr (coloured)
            for (int lane = 0; lane < laneCount; ++lane)
                phase_[lane] = volume.reflected.phase({rays.along[0][lane], rays.along[1][lane], rays.along[2][lane]});
        const glm::vec3 cells(volume.density.cells.cells());
        const Stretches box = rays.within(glm::vec3(0), cells);
        Stretches filled = box;
        if (volume.bricks)
            filled = rays.within(glm::vec3(volume.bricks->minimum()), glm::vec3(volume.bricks->maximum()));
        filled.to = atMost(filled.to, sceneDistance);
        const Ints hits = filled.from < filled.to;
        // Rays that miss get zero length.
        from_ = box.from;
        end_ = hits ? atMost(box.to, sceneDistance) : from_;
        first_ = minimum(hits ? filled.from : all(std::numeric_limits<float>::max()));
        last_ = maximum(hits ? filled.to : all(0));
    }

    [[gnu::always_inline]] void march() {
        if (!(first_ < last_)) return;
        const float lastFrom = maximum(from_), firstEnd = minimum(end_);
        for (int k = static_cast<int>(std::min(std::floor(first_ / step_), 1e9f)) - 1;
             step_ * static_cast<float>(k) < last_; k += stepsPerChunk) {
            const float begin = step_ * static_cast<float>(k), end = begin + step_ * (stepsPerChunk + 1);
            const float nearest = std::max(begin, first_), farthest = std::min(end, last_);
            if (volume_.bricks &&
                !anyOccupied(*volume_.bricks, rays_.low(nearest, farthest), rays_.high(nearest, farthest)))
                continue;
            if (lastFrom <= begin && end <= firstEnd)
                for (int i = 0; i < stepsPerChunk; ++i) step<false>(step_ * static_cast<float>(k + i));
            else
                for (int i = 0; i < stepsPerChunk; ++i) step<true>(step_ * static_cast<float>(k + i));
            if (minimum(depth_) > opaque_) break;
        }
    }

    [[nodiscard]] Floats alpha() const { return 1 - expMinus(depth_ * volume_.extinctionPerCell); }
    [[nodiscard]] const Floats& colour(int channel) const { return colour_[channel]; }

 private:
    /// Advances each ray by the step that begins at `begin` plus its jitter; `cut` if some steps may be partial.
    template <bool cut>
    [[gnu::always_inline]] void step(float begin) {
        Floats middle = begin + 0.5f * step_ + shift_, length = all(step_);
        if constexpr (cut) {
            const Floats from = atLeast(begin + shift_, from_), to = atMost(begin + shift_ + step_, end_);
            middle = 0.5f * (from + to);
            length = atLeast(to - from, all(0));
        }
        length = depth_ > opaque_ ? all(0) : length;
        // The middle of a partial step may lie anywhere within it.
        const Reach reach{middle, begin + (cut ? 0.0f : 0.5f) * step_, begin + (cut ? 2.0f : 1.5f) * step_};
        gather(reach, length * sample(volume_.density, reach));
    }

    /// Sample positions of the rays: distances, and lower and upper bounds for all of them.
    struct Reach {
        const Floats& middle;
        float nearest, farthest;
    };

    [[gnu::always_inline]] [[nodiscard]] Floats sample(const Field& field, const Reach& reach) const {
        return cubic ? sampleCubic(field.cells, places(reach.middle, Four{}, 1)) : sampleLinear(field, reach, 1);
    }

    /// `perCell`: that of the field; passed separately so that the compiler may know that it is 1.
    [[gnu::always_inline]] [[nodiscard]] Floats sampleLinear(const Field& field, const Reach& reach,
                                                             float perCell) const {
        const Four low = perCell * rays_.low(reach.nearest, reach.farthest) - 0.5f;
        const Four high = perCell * rays_.high(reach.nearest, reach.farthest) - 0.5f;
        const Four outside{-1, -1, -1, 0};
        const FourInts base = __builtin_convertvector(atMost(atLeast(low, outside), field.last) - outside, FourInts) +
                              FourInts{-1, -1, -1, 0};
        const Four whole = __builtin_convertvector(base, Four);
        const FourInts beyond = atMost(high, field.last + 0.5f) - whole > Four{2.999f, 2.999f, 1.999f, 1e30f};
        if (CellWindow::useful && (beyond[0] | beyond[1] | beyond[2]) == 0) {
            const float* const from = field.origin + base[0] + base[1] * field.row + base[2] * field.slab;
            return CellWindow(from, field.row, field.slab).sample(places(reach.middle, whole, perCell));
        }
        return sampleAnywhere(field.cells, places(reach.middle, Four{}, perCell));
    }

    /// Positions relative to the middle of a cell.
    [[gnu::always_inline]] [[nodiscard]] Places places(const Floats& distance, const Four& cell, float perCell) const {
        const Four eye = perCell * rays_.eye - 0.5f - cell;
        const Floats scaled = perCell * distance;
        return {eye[0] + scaled * rays_.along[0], eye[1] + scaled * rays_.along[1], eye[2] + scaled * rays_.along[2]};
    }

    /// D ← D + σ·Δ,   C ← C + (T before − T after)·(reflected + emission)
    [[gnu::always_inline]] void gather(const Reach& reach, Floats step) {
        if constexpr (coloured) {
            if (maximum(step) <= 0) return;
            Floats source[3];
            const Floats light =
                volume_.light ? phase_ * sampleLinear(*volume_.light, reach, volume_.light->perCell) : all(1);
            for (int channel = 0; channel < 3; ++channel)
                source[channel] = volume_.reflected.ambient[channel] + volume_.reflected.sun[channel] * light;
            if (volume_.reaction) {
                const Burning look = burningAt(sample(*volume_.reaction, reach));
                step *= look.extinction;
                for (int channel = 0; channel < 3; ++channel) source[channel] += look.emission[channel];
            }
            const Floats left = expMinus((depth_ + step) * volume_.extinctionPerCell), share = transmittance_ - left;
            for (int channel = 0; channel < 3; ++channel) colour_[channel] += share * source[channel];
            transmittance_ = left;
        }
        depth_ += step;
    }

    struct Burning {
        Floats emission[3], extinction;
    };
    [[nodiscard]] Burning burningAt(const Floats& reaction) const {
        const std::span<const glm::vec4> fire = volume_.fire;
        const Floats at = atLeast(atMost(reaction, all(1)), all(0)) * static_cast<float>(fire.size() - 1);
        if (maximum(at) <= 0) return {{all(fire[0].r), all(fire[0].g), all(fire[0].b)}, all(fire[0].a)};
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
    float opaque_;  ///< in the unit of `depth_`: without the extinction of a density of 1
    Floats shift_;
    Floats phase_ = all(1);  ///< of each ray: Reflected::phase
    Floats from_, end_;      ///< of each ray, within the grid and before the scene
    float first_, last_;     ///< everything visible lies between them
    Floats depth_{};
    Floats transmittance_ = all(1);
    Floats colour_[3]{};
};

template <bool coloured, bool cubic>
void marchAll(const Volume& volume, const PixelRays& rays, const SceneDepths& depths, bool jitter,
              const PacketPicture& picture) {
    parallel::forEachBlock(picture.packets(), packetsPerBlock, [&](std::size_t first, std::size_t count) {
        const auto across = static_cast<std::size_t>(picture.packetsAcross());
        for (std::size_t p = first; p < first + count; ++p) {
            const int x = picture.rectangle.left + PacketPicture::edge * static_cast<int>(p % across);
            const int y = picture.rectangle.bottom + PacketPicture::edge * static_cast<int>(p / across);
            const RayPacket packet(rays, x, y);
            PacketMarch<coloured, cubic> march(volume, packet, jitter ? packet.jitter : Floats{},
                                               sceneDistance(rays, depths, x, y, packet.stretch));
            march.march();
            float* to = picture.values.data() + p * PacketPicture::pixels * static_cast<std::size_t>(picture.channels);
            if constexpr (coloured)
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

void CpuMarch::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    density_.set(grid.cells, grid.density);
    burning_ = !grid.reaction.empty();
    if (burning_) reaction_.set(grid.cells, grid.reaction);
    extinctionPerCell_ = static_cast<float>(settings_.extinctionPerMetre * grid.spacingMetres);
    bricks_ = &bricks;
    light_ = light;
}

void CpuMarch::march(const PixelRays& rays, const SceneDepths& depths, const Reflected& reflected,
                     const PacketPicture& picture, float thickness) const {
    Volume volume{Field(density_),
                  std::nullopt,
                  std::nullopt,
                  settings_.skipEmpty ? bricks_ : nullptr,
                  fire_,
                  reflected,
                  static_cast<float>(settings_.stepCells),
                  extinctionPerCell_ * thickness,
                  opaqueDepth(settings_)};
    if (burning_) volume.reaction.emplace(reaction_);
    if (light_) volume.light.emplace(light_->padded(), 1 / static_cast<float>(light_->texelCells()));
    const bool cubic = settings_.filter == Filter::cubic;
    const auto all = channels() == 4 ? (cubic ? marchAll<true, true> : marchAll<true, false>)
                                     : (cubic ? marchAll<false, true> : marchAll<false, false>);
    all(volume, rays, depths, settings_.jitter, picture);
}

}  // namespace dustbench::raycast
