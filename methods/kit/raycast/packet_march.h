// The march of sixteen rays at a time through a medium; a template parameter provides the densities.
//
//     D ← D + σ·Δ,   T = e^(−D),   C ← C + (T before − T after)·(reflected + emission)
//
// A `Probe` is made for each packet and provides the medium along its rays:
//     Floats density(const Reach&), Floats reaction(const Reach&)    values at the steps' middles
//     int clearChunks(float begin, float nearest, float farthest)    number of empty chunks from the step at `begin`
//         on; 0 if the range of distances nearest to farthest, which covers the first of them, may not be
//         empty
// Units: cells; positions are relative to the grid's minimum corner. Internal to marches on the CPU.
// Threads: marchPackets() runs in parallel. Source: Senger2009, ch. 4.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/raycast/cell_window.h"
#include "methods/kit/raycast/cpu_march.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

/// Sections of sixteen rays, as distances from the eye.
struct Stretches {
    Floats from, to;
};

/// The rays of 4×4 neighbouring pixels.
struct RayPacket {
    /// Pixels (x, y) to (x + 3, y + 3).
    RayPacket(const PixelRays& rays, int x, int y) : eye{rays.eye.x, rays.eye.y, rays.eye.z, 0} {
        Floats column, row;
        for (int lane = 0; lane < laneCount; ++lane) {
            const int pixelX = x + lane % 4, pixelY = y + lane / 4;
            column[lane] = static_cast<float>(pixelX) + 0.5f;
            row[lane] = static_cast<float>(pixelY) + 0.5f;
            jitter[lane] = jitterOf(static_cast<std::uint32_t>(pixelX), static_cast<std::uint32_t>(pixelY));
        }
        Floats squares{};
        for (int axis = 0; axis < 3; ++axis) {
            along[axis] = rays.corner[axis] + column * rays.right[axis] + row * rays.up[axis];
            squares += along[axis] * along[axis];
        }
        for (int lane = 0; lane < laneCount; ++lane) stretch[lane] = std::sqrt(squares[lane]);
        for (int axis = 0; axis < 3; ++axis) {
            Floats& a = along[axis];
            a /= stretch;
            const Floats size = a < 0 ? -a : a;
            a = size < 1e-12f ? all(1e-12f) : a;  // finite quotients
            slowest[axis] = minimum(a);
            fastest[axis] = maximum(a);
        }
    }

    /// Section of each ray between two corners; from > to for rays that miss.
    [[nodiscard]] Stretches within(const glm::vec3& low, const glm::vec3& high) const {
        Stretches parts{Floats{}, all(std::numeric_limits<float>::max())};
        for (int axis = 0; axis < 3; ++axis) {
            const Floats a = (low[axis] - eye[axis]) / along[axis], b = (high[axis] - eye[axis]) / along[axis];
            parts.from = atLeast(parts.from, atMost(a, b));
            parts.to = atMost(parts.to, atLeast(a, b));
        }
        return parts;
    }

    /// Corners of the box that contains all rays between two distances.
    [[gnu::always_inline]] [[nodiscard]] Four low(float from, float to) const {
        return eye + atMost(from * slowest, to * slowest);
    }
    [[gnu::always_inline]] [[nodiscard]] Four high(float from, float to) const {
        return eye + atLeast(from * fastest, to * fastest);
    }

    Four eye;
    Floats along[3];            ///< unit directions
    Four slowest{}, fastest{};  ///< minimum and maximum direction, by axis
    Floats stretch;             ///< length of each ray per unit along the camera's axis
    Floats jitter;
};

/// Steps that are skipped as a unit.
inline constexpr int stepsPerChunk = 4;

/// Sample positions of the rays: distances, and lower and upper bounds for all of them.
struct Reach {
    const Floats& middle;
    float nearest, farthest;
};

/// A dense grid to sample, with the number of its cells per cell of the shown grid.
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

/// Positions relative to the middle of a cell.
[[gnu::always_inline]] [[nodiscard]] inline Places placesOf(const RayPacket& rays, const Floats& distance,
                                                            const Four& cell, float perCell) {
    const Four eye = perCell * rays.eye - 0.5f - cell;
    const Floats scaled = perCell * distance;
    return {eye[0] + scaled * rays.along[0], eye[1] + scaled * rays.along[1], eye[2] + scaled * rays.along[2]};
}

/// `perCell`: that of the field; passed separately so that the compiler may know that it is 1.
[[gnu::always_inline]] [[nodiscard]] inline Floats sampleLinear(const Field& field, const RayPacket& rays,
                                                                const Reach& reach, float perCell) {
    const Four low = perCell * rays.low(reach.nearest, reach.farthest) - 0.5f;
    const Four high = perCell * rays.high(reach.nearest, reach.farthest) - 0.5f;
    const Four outside{-1, -1, -1, 0};
    const FourInts base = __builtin_convertvector(atMost(atLeast(low, outside), field.last) - outside, FourInts) +
                          FourInts{-1, -1, -1, 0};
    const Four whole = __builtin_convertvector(base, Four);
    const FourInts beyond = atMost(high, field.last + 0.5f) - whole > Four{2.999f, 2.999f, 1.999f, 1e30f};
    if (CellWindow::useful && (beyond[0] | beyond[1] | beyond[2]) == 0) {
        const float* const from = field.origin + base[0] + base[1] * field.row + base[2] * field.slab;
        return CellWindow(from, field.row, field.slab).sample(placesOf(rays, reach.middle, whole, perCell));
    }
    return sampleAnywhere(field.cells, placesOf(rays, reach.middle, Four{}, perCell));
}

/// Inputs of a march other than densities.
struct Medium {
    glm::ivec3 cells;             ///< of the box in which steps are taken
    bool skipsEmpty = true;       ///< skips empty chunks
    glm::ivec3 minimum, maximum;  ///< everything visible is in [minimum, maximum)
    bool burning = false;
    std::optional<Field> light;  ///< empty: no shadow
    std::span<const glm::vec4> fire;
    Reflected reflected;
    float stepCells, extinctionPerCell, opaqueDepth;
};

/// Converts the scene's depths to distances along the rays of a packet.
[[nodiscard]] inline Floats sceneDistance(const PixelRays& rays, const SceneDepths& depths, int x, int y,
                                          const Floats& stretch) {
    Floats depth;
    for (int lane = 0; lane < laneCount; ++lane) {
        const int column = std::min(x + lane % 4, depths.width - 1), row = std::min(y + lane / 4, depths.height - 1);
        depth[lane] = depths.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(depths.width) +
                                    static_cast<std::size_t>(column)];
    }
    return rays.nearDistance / atLeast(depth, all(1e-9f)) * stretch;
}

/// Marches one packet through a medium.
template <typename Probe, bool coloured>
class PacketMarch {
 public:
    PacketMarch(const Medium& medium, Probe& probe, const RayPacket& rays, const Floats& jitter,
                const Floats& sceneDistance)
        : medium_(medium),
          probe_(probe),
          rays_(rays),
          step_(medium.stepCells),
          opaque_(medium.opaqueDepth / medium.extinctionPerCell),
          shift_(jitter * medium.stepCells) {
        if constexpr (coloured)
            for (int lane = 0; lane < laneCount; ++lane)
                phase_[lane] = medium.reflected.phase({rays.along[0][lane], rays.along[1][lane], rays.along[2][lane]});
        const Stretches box = rays.within(glm::vec3(0), glm::vec3(medium.cells));
        Stretches filled = box;
        if (medium.skipsEmpty) filled = rays.within(glm::vec3(medium.minimum), glm::vec3(medium.maximum));
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
            if (medium_.skipsEmpty) {
                const int clear = probe_.clearChunks(begin, std::max(begin, first_), std::min(end, last_));
                if (clear > 0) {
                    k += stepsPerChunk * (clear - 1);
                    continue;
                }
            }
            if (lastFrom <= begin && end <= firstEnd)
                for (int i = 0; i < stepsPerChunk; ++i) step<false>(step_ * static_cast<float>(k + i));
            else
                for (int i = 0; i < stepsPerChunk; ++i) step<true>(step_ * static_cast<float>(k + i));
            if (minimum(depth_) > opaque_) break;
        }
    }

    [[nodiscard]] Floats alpha() const { return 1 - expMinus(depth_ * medium_.extinctionPerCell); }
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
        gather(reach, length * probe_.density(reach));
    }

    /// D ← D + σ·Δ,   C ← C + (T before − T after)·(reflected + emission)
    [[gnu::always_inline]] void gather(const Reach& reach, Floats step) {
        if constexpr (coloured) {
            if (maximum(step) <= 0) return;
            Floats source[3];
            const Floats light =
                medium_.light ? phase_ * sampleLinear(*medium_.light, rays_, reach, medium_.light->perCell) : all(1);
            for (int channel = 0; channel < 3; ++channel)
                source[channel] = medium_.reflected.ambient[channel] + medium_.reflected.sun[channel] * light;
            if (medium_.burning) {
                const Burning look = burningAt(probe_.reaction(reach));
                step *= look.extinction;
                for (int channel = 0; channel < 3; ++channel) source[channel] += look.emission[channel];
            }
            const Floats left = expMinus((depth_ + step) * medium_.extinctionPerCell), share = transmittance_ - left;
            for (int channel = 0; channel < 3; ++channel) colour_[channel] += share * source[channel];
            transmittance_ = left;
        }
        depth_ += step;
    }

    struct Burning {
        Floats emission[3], extinction;
    };
    [[nodiscard]] Burning burningAt(const Floats& reaction) const {
        const std::span<const glm::vec4> fire = medium_.fire;
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

    const Medium& medium_;
    Probe& probe_;
    const RayPacket& rays_;
    float step_;
    float opaque_;  ///< in units of `depth_`, without the extinction of a density of 1
    Floats shift_;
    Floats phase_ = all(1);  ///< of each ray: Reflected::phase
    Floats from_, end_;      ///< of each ray, within the grid and before the scene
    float first_, last_;     ///< everything visible lies between them
    Floats depth_{};
    Floats transmittance_ = all(1);
    Floats colour_[3]{};
};

/// Marches all packets of a picture, with a `Probe(source, rays)` for each.
template <typename Probe, bool coloured, typename Source>
void marchPackets(const Medium& medium, const Source& source, const PixelRays& rays, const SceneDepths& depths,
                  bool jitter, const PacketPicture& picture) {
    constexpr std::size_t packetsPerBlock = 64;
    parallel::forEachBlock(picture.packets(), packetsPerBlock, [&](std::size_t first, std::size_t count) {
        const auto across = static_cast<std::size_t>(picture.packetsAcross());
        for (std::size_t p = first; p < first + count; ++p) {
            const int x = picture.rectangle.left + PacketPicture::edge * static_cast<int>(p % across);
            const int y = picture.rectangle.bottom + PacketPicture::edge * static_cast<int>(p / across);
            const RayPacket packet(rays, x, y);
            Probe probe(source, packet);
            PacketMarch<Probe, coloured> march(medium, probe, packet, jitter ? packet.jitter : Floats{},
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

}  // namespace dustbench::raycast
