// Dust as the voxels of an octree: what both octree methods have in common, which is all but the way of building.
//
// Each frame the tree is built anew over a cube that goes with the vehicle and its trail; its voxels are listed, faded
// if wanted, and drawn as billboards, as cubes or by a march through the tree.
//
// Source: Carr2006, 3.2 and 3.5. Departs: opacity by one optical model for all methods (maths/transmittance.h).
#pragma once

#include <memory>
#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/cubes.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/octree/cross_fade.h"
#include "methods/kit/octree/octree_builder.h"
#include "methods/kit/octree/octree_march.h"
#include "methods/kit/octree/voxel_cloud.h"

namespace dustbench::octree {

/// What a voxel is drawn as.
enum class Render {
    billboards,  ///< a plain, smoothly faded circle
    cubes,       ///< six faces
    raycast,     ///< a march through the tree
};
inline constexpr Choices<Render> renders{
    {"billboards", Render::billboards}, {"cubes", Render::cubes}, {"raycast", Render::raycast}};

struct DustSettings {
    OctreeSettings tree;
    Render render = Render::billboards;
    draw::SortKind sort = draw::SortKind::radix;
    bool crossFade = false;
    double crossFadeSeconds = 0.1;
    double worldEdgeMetres = 128;
};

/// Adds all of the above to a method's parameters, and what OctreeDust reports to its facts.
DUSTBENCH_API void declareDust(MethodInfo& info);
/// Throws InputError where the values do not go together.
[[nodiscard]] DUSTBENCH_API DustSettings dustSettings(const ParameterValues& values);

class DUSTBENCH_API OctreeDust final : public Method {
 public:
    /// `makeBuilder` books the builder's memory on the method's ledger.
    using MakeBuilder = std::function<std::unique_ptr<OctreeBuilder>(MemoryLedger&)>;
    OctreeDust(const DustSettings& settings, const MakeBuilder& makeBuilder);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override { return static_cast<std::int64_t>(shown().size()); }

    [[nodiscard]] const Octree& tree() const { return tree_; }
    /// What is drawn.
    [[nodiscard]] const VoxelCloud& shown() const { return *shown_; }

 private:
    void build(const Frame& frame);
    /// Of the particles' optical mass; empty where they have none.
    [[nodiscard]] std::optional<double> massKept(const Puffs& dust) const;
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
    std::int64_t clipped_ = 0;
    std::optional<draw::Billboards> billboards_;
    std::optional<draw::Cubes> cubes_;
    std::optional<OctreeMarch> march_;
};

}  // namespace dustbench::octree
