// A volume stored as one box of cells, drawn by any grid renderer.
//
// Owns: the moments of the series, and the picture.
#pragma once

#include <span>
#include <vector>

#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/volumes/volume_series.h"
#include "methods/volume/storage.h"

namespace dustbench::volume {

class DenseStorage final : public Storage {
 public:
    /// Reads the files. `device` must outlive this. Throws InputError.
    DenseStorage(const VolumeSettings& settings, const scene::Lights& lights, gpu::Device& device);

    [[nodiscard]] bool isStill() const override { return series_.isStill(); }
    [[nodiscard]] double seconds() const override { return series_.seconds(); }
    void show(double seconds, const StageClock& clock) override;
    void draw(const scene::View& view, gpu::Layer& layer) override { picture_.draw(view, layer); }
    void handOver(double seconds, VolumeVisitor& visitor) const override;
    [[nodiscard]] double massSquareMetres() const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override { return picture_.primitives(); }

 private:
    /// Freshness of fire by temperature; empty without fire.
    [[nodiscard]] std::span<const float> reactionOf(const volumes::VolumeGrid& grid);

    VolumeSettings settings_;
    volumes::VolumeSeries series_;
    volumes::VolumeGrid between_;                 ///< the interpolated grid between two moments
    const volumes::VolumeGrid* shown_ = nullptr;  ///< a moment, or `between_`
    std::vector<float> reaction_;
    MemoryLedger ledger_;
    raycast::GridRaycast picture_;
};

}  // namespace dustbench::volume
