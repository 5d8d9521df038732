// A volume stored as its non-empty bricks, drawn by ray casting.
//
// Owns: the moments of the series, and the picture.
#pragma once

#include "methods/volume/sparse/sparse_picture.h"
#include "methods/volume/sparse/sparse_series.h"
#include "methods/volume/storage.h"

namespace dustbench::volume {

class SparseStorage final : public Storage {
 public:
    /// Reads the files. `device` must outlive this. Throws InputError.
    SparseStorage(const VolumeSettings& settings, const scene::Lights& lights, gpu::Device& device);

    [[nodiscard]] bool isStill() const override { return series_.isStill(); }
    [[nodiscard]] double seconds() const override { return series_.seconds(); }
    void show(double seconds, const StageClock& clock) override;
    void draw(const scene::View& view, gpu::Layer& layer) override { picture_.draw(view, layer); }
    /// Hands over the whole box of cells with its density. Throws InputError if it has more cells than a dense volume
    /// may have.
    void handOver(double seconds, VolumeVisitor& visitor) const override;
    [[nodiscard]] double massSquareMetres() const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override { return picture_.primitives(); }

 private:
    MemoryLedger ledger_;
    raycast::RaycastSettings settings_;
    mutable SparseSeries series_;  ///< mutable because it caches the shown moment
    SparsePicture picture_;
    std::int64_t shows_ = -1;  ///< SparseSeries::shows of the last upload
};

}  // namespace dustbench::volume
