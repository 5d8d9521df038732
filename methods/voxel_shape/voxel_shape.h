// Objects made of particles that keep their shape: a mesh is voxelised, and the voxels determine how the particles in
// them look and move.
//
// Source: JuckelBeckhaus2007. Departs: formulas where the paper gives none (voxels/voxel_grid.h); puff sizes and
// opacities follow the optical model of all methods; births by the number of particles a voxel lacks
// (particles/shape_system.h).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "methods/contract/method.h"
#include "methods/voxel_shape/living_shape.h"
#include "methods/voxel_shape/shape_picture.h"

namespace dustbench::voxel_shape {

class VoxelShape final : public Method {
 public:
    explicit VoxelShape(const Shape& shape);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    /// Throws std::runtime_error if the number of particles held deviates more from a shape's number than requested.
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;
    [[nodiscard]] std::optional<std::uint64_t> stateHash() const override;
    [[nodiscard]] bool wantsPreroll() const override { return true; }

    /// The system of the only or first shape.
    [[nodiscard]] const ShapeSystem& system() const { return shapes_.front().system(); }
    /// Returns how well the particles reproduce the outline of their mesh (silhouette.h), drawn without occluders;
    /// empty if the shape has no mesh or there are several shapes.
    [[nodiscard]] std::optional<double> silhouetteOverlap(const scene::View& view) const;

 private:
    void simulate(const Frame& frame);
    [[nodiscard]] ShapeCount count() const;

    MemoryLedger ledger_;
    std::vector<LivingShape> shapes_;  ///< all are drawn with the look of the first one
    const scene::Scene* scene_ = nullptr;
    gpu::Device* device_ = nullptr;
    DrawOrder order_;
    MergedParticles merged_;
    std::unique_ptr<ShapePicture> picture_;
};

/// Declares the method; called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::voxel_shape
