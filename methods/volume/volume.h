// A volume that another program made: a file of densities, or a series of them, shown by ray casting.
//
// Frame 0 shows the first moment, which preroll and warm-up hold. Between two moments density and temperature change
// evenly; the last one stays, which makes a run invalid. Temperature, if there is a transfer function for it, is shown
// as fire.
#pragma once

#include <optional>
#include <vector>

#include "methods/contract/method.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/volumes/volume_series.h"

namespace dustbench::volume {

struct VolumeSettings {
    volumes::VolumeSetup setup;
    raycast::RaycastSettings picture;
};

class Volume final : public Method {
 public:
    explicit Volume(VolumeSettings settings) : settings_(std::move(settings)) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override { return picture_ ? picture_->primitives() : 0; }

 private:
    /// Freshness of fire by temperature; empty without fire.
    [[nodiscard]] std::span<const float> reactionOf(const volumes::VolumeGrid& grid);

    VolumeSettings settings_;
    std::optional<volumes::VolumeSeries> series_;
    volumes::VolumeGrid between_;                 ///< what is shown between two moments
    const volumes::VolumeGrid* shown_ = nullptr;  ///< a moment, or `between_`
    std::vector<float> reaction_;
    MemoryLedger ledger_;
    std::optional<raycast::GridRaycast> picture_;
};

/// What the method declares; the registry asks for it.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::volume
