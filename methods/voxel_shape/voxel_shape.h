// Things made of particles that still know their shape: a mesh becomes voxels, and the voxels say how the particles in
// them look and move.
//
// Source: JuckelBeckhaus2007. Departs: formulas where the paper gives none (voxels/voxel.h); sizes of puffs and
// opacities by the one optical model for all methods; births by the voxels' lack together (particles/emission.h).
#pragma once

#include <memory>
#include <optional>

#include "methods/contract/method.h"
#include "methods/voxel_shape/collision/shape_collision.h"
#include "methods/voxel_shape/draw_order.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/shape_picture.h"
#include "methods/voxel_shape/shape_track.h"

namespace dustbench::voxel_shape {

class VoxelShape final : public Method {
 public:
    explicit VoxelShape(const Shape& shape);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;
    [[nodiscard]] std::optional<std::uint64_t> stateHash() const override;
    [[nodiscard]] bool wantsPreroll() const override { return true; }

    [[nodiscard]] const ShapeSystem& system() const { return *system_; }

 private:
    void simulate(const Frame& frame, const Pose& pose);

    Shape shape_;
    MemoryLedger ledger_;
    ShapeTrack track_;
    DrawOrder order_;
    std::optional<ShapeSystem> system_;
    std::optional<ShapeCollision> collision_;
    std::optional<ShapePicture> picture_;
};

/// What the method declares; the registry asks for it.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::voxel_shape
