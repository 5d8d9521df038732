// A volume from another program: a file of densities, or a series of them, shown by ray casting.
//
// Frame 0 shows the first moment; preroll and warm-up show it too. Between two moments density and temperature change
// linearly. After the end of a series the last moment stays, which makes a run invalid. Temperature is shown as fire if
// there is a transfer function for it. The volume is stored as one box of cells, or sparse.
#pragma once

#include <memory>

#include "methods/volume/storage.h"

namespace dustbench::volume {

/// The part of a volume that is kept in memory.
enum class Keeps {
    dense,   ///< every cell of the box around its density
    sparse,  ///< only bricks with density
};
inline constexpr Choices<Keeps> keepings{{"dense", Keeps::dense}, {"sparse", Keeps::sparse}};

class Volume final : public Method {
 public:
    Volume(VolumeSettings settings, Keeps keeps) : settings_(std::move(settings)), keeps_(keeps) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override { return storage_ ? storage_->memory() : MemoryReport(); }
    [[nodiscard]] std::int64_t primitives() const override { return storage_ ? storage_->primitives() : 0; }

 private:
    VolumeSettings settings_;
    Keeps keeps_;
    std::unique_ptr<Storage> storage_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::volume
