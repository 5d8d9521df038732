// Maps of one moment that are computed on the CPU: FLIP between the halves, and overdraw, outlines and faults of each.
//
// Owns: the maps' textures. Threads: the device's, inside the oneTBB arena to be used.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "bench/export/collected_volume.h"
#include "bench/measure/image/picture.h"
#include "bench/view/view_session.h"
#include "methods/contract/view.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::view {

/// Number of pixels of a layer with values that are impossible in a picture.
struct LayerFaults {
    std::int64_t notFinite = 0;
    std::int64_t negative = 0;          ///< a colour
    std::int64_t alpha = 0;             ///< outside [0, 1], beyond rounding
    std::optional<glm::ivec2> first{};  ///< of them, from the upper left corner
};
[[nodiscard]] LayerFaults faultsOf(const pictures::Image& layer);

class MomentMaps {
 public:
    explicit MomentMaps(gpu::Device& device) : device_(device) {}

    /// FLIP of A's picture with B's as reference, in heat colours from 0 to 1. Computed once per moment. Throws
    /// InputError for pictures with values that are not finite.
    [[nodiscard]] const gpu::Texture& flip(const ViewSession& session);
    /// Mean of the last map, and how long it took; empty before the first.
    [[nodiscard]] std::optional<double> flipMean() const { return flipMean_; }
    [[nodiscard]] double flipSeconds() const { return flipSeconds_; }

    /// Number of primitives over each pixel in heat colours from 0 to `overdrawLimit`, on one scale for both halves. A
    /// half without primitives is black.
    [[nodiscard]] const gpu::Texture& overdraw(ViewSession& session, Half half);
    /// Outlines of the primitives over the darkened picture (withOutlines). The half must be current.
    [[nodiscard]] const gpu::Texture& outlines(ViewSession& session, Half half);
    [[nodiscard]] double overdrawLimit() const { return overdrawLimit_; }

    /// The half must be current.
    [[nodiscard]] const LayerFaults& faults(const ViewSession& session, Half half);

 private:
    static constexpr std::int64_t never = -1;

    void makeFlip(const ViewSession& session);
    void makeOverdraw(ViewSession& session);
    void fit(gpu::Texture& texture, const char* label, const ViewSession& session);

    gpu::Device& device_;
    gpu::Texture flip_;
    std::array<gpu::Texture, 2> overdraw_, outlines_;
    std::int64_t flipMoment_ = never, overdrawMoment_ = never;
    std::array<std::int64_t, 2> faultsMoment_{never, never}, outlinesMoment_{never, never};
    std::array<LayerFaults, 2> faults_;
    std::optional<double> flipMean_;
    double flipSeconds_ = 0, overdrawLimit_ = 1;
};

/// How many outlines of a method's primitives pass through each pixel, with rows from the top: the quad around each
/// puff, the twelve edges of each voxel. Neither the scene nor other primitives hide them.
struct Outlines {
    measure::Plane quads;   ///< of puffs: squares that face the camera, with half side 1.5 r, as in overdrawMap
    measure::Plane voxels;  ///< edges of the octrees' voxels, clipped in front of the eye
};
[[nodiscard]] Outlines outlinesOf(const exports::CollectedVolume& volume, const scene::View& view);

/// Draws quads yellow and voxels blue over the darkened picture, brighter where several overlap. Linear light. Throws
/// std::invalid_argument if the sizes differ.
[[nodiscard]] pictures::Image withOutlines(pictures::Image picture, const Outlines& outlines);

}  // namespace dustbench::view
