// Things made of particles that still know their shape: a mesh becomes voxels, and the voxels say how the particles in
// them look and move.
//
// Source: JuckelBeckhaus2007. Departs: formulas where the paper gives none (voxels/voxel.h); sizes of puffs and
// opacities by the one optical model for all methods; births by the voxels' lack together (particles/emission.h).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "methods/contract/method.h"
#include "methods/voxel_shape/draw_order.h"
#include "methods/voxel_shape/living_shape.h"
#include "methods/voxel_shape/merged_particles.h"
#include "methods/voxel_shape/shape_picture.h"

namespace dustbench::voxel_shape {

class VoxelShape final : public Method {
 public:
    explicit VoxelShape(const Shape& shape);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    /// Throws std::runtime_error where voxels hold another number of particles than their shape was asked to keep to.
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;
    [[nodiscard]] std::optional<std::uint64_t> stateHash() const override;
    [[nodiscard]] bool wantsPreroll() const override { return true; }

    /// Of the shape, or of the first of several.
    [[nodiscard]] const ShapeSystem& system() const { return shapes_.front().system(); }
    /// How well the particles keep the outline of their mesh (silhouette.h), drawn as if nothing stood before them;
    /// empty where the shape is of no mesh, and where there are several.
    [[nodiscard]] std::optional<double> silhouetteOverlap(const scene::View& view) const;

 private:
    void simulate(const Frame& frame);
    [[nodiscard]] ShapeCount count() const;

    MemoryLedger ledger_;
    std::vector<LivingShape> shapes_;  ///< the first one's look is that of all
    const scene::Scene* scene_ = nullptr;
    gpu::Device* device_ = nullptr;
    DrawOrder order_;
    MergedParticles merged_;
    std::unique_ptr<ShapePicture> picture_;
};

/// What the method declares; the registry asks for it.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::voxel_shape
