// Dust as the voxels of an octree: what both octree methods have in common, which is all but the way of building.
//
// Each frame the tree is built anew over a cube that goes with the vehicle and its trail; its voxels are listed, faded
// if wanted, and drawn as billboards, as cubes or by a march through the tree.
//
// Source: Carr2006, 3.2 and 3.5. Departs: opacity by one optical model for all methods (maths/transmittance.h).
#pragma once

#include <memory>
#include <optional>

#include "methods/shared/draw/billboards.h"
#include "methods/shared/draw/cubes.h"
#include "methods/shared/draw/depth_sort.h"
#include "methods/shared/method.h"
#include "methods/shared/octree/cross_fade.h"
#include "methods/shared/octree/octree_builder.h"
#include "methods/shared/octree/octree_march.h"
#include "methods/shared/octree/voxel_cloud.h"

namespace dustbench::octree {

/// What a voxel is drawn as.
enum class Render {
    billboards,  ///< a plain, smoothly faded circle
    cubes,       ///< six faces
    raycast,     ///< a march through the tree
};

struct DustSettings {
    OctreeSettings tree;
    Render render = Render::billboards;
    draw::SortKind sort = draw::SortKind::radix;
    bool crossFade = false;
    double crossFadeSeconds = 0.1;
};

/// Adds all of the above to a method's parameters.
void declareDustParameters(ParameterSet& parameters);
/// Throws InputError where the values do not go together.
[[nodiscard]] DustSettings dustSettings(const ParameterValues& values);

class OctreeDust final : public Method {
 public:
    /// `makeBuilder` books the builder's memory on the method's ledger.
    using MakeBuilder = std::function<std::unique_ptr<OctreeBuilder>(MemoryLedger&)>;
    OctreeDust(const DustSettings& settings, const MakeBuilder& makeBuilder);

    void prepare(const scene::Scene& scene, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    [[nodiscard]] std::optional<std::int64_t> clipped() const override { return clipped_; }
    [[nodiscard]] std::optional<double> massKept(const Frame& frame) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override { return static_cast<std::int64_t>(shown().size()); }

    [[nodiscard]] const Octree& tree() const { return tree_; }
    /// What is drawn.
    [[nodiscard]] const VoxelCloud& shown() const { return *shown_; }

 private:
    void build(const Frame& frame);
    void uploadBillboards(std::span<const std::uint32_t> order);
    void uploadCubes(std::span<const std::uint32_t> order);
    void uploadTree();

    DustSettings settings_;
    MemoryLedger ledger_;
    std::unique_ptr<OctreeBuilder> builder_;
    Octree tree_;
    Octree shownTree_;  ///< of the faded voxels, where a march needs one
    VoxelCloud cloud_;
    std::optional<CrossFade> fade_;
    const VoxelCloud* shown_ = &cloud_;
    draw::DepthSort sort_;
    LedgerVector<float> extinctions_;
    LedgerVector<glm::vec3> colours_;
    double worldEdgeMetres_ = 0;
    std::int64_t clipped_ = 0;
    std::optional<draw::Billboards> billboards_;
    std::optional<draw::Cubes> cubes_;
    std::optional<OctreeMarch> march_;
};

}  // namespace dustbench::octree
