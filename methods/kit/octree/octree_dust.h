// Draws dust as octree voxels: everything that the two octree methods share, which is all but the construction.
//
// Each frame rebuilds the tree over a cube that follows the vehicle and its trail and lists its voxels, or keeps those
// of the last two trees and interpolates between them; optionally cross-fades them; and draws them as billboards, as
// cubes or by ray marching through the tree.
//
// Source: Carr2006, 3.2 and 3.5. `mode=paper` sets a voxel's opacity by age alone and draws it as a plain circle.
// Departs in `mode=fixed`: opacity follows the optical model shared by all methods (maths/transmittance.h).
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "methods/contract/method.h"
#include "methods/contract/volume.h"
#include "methods/kit/draw/age_opacity.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/cubes.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_march.h"
#include "methods/kit/octree/octree_settings.h"
#include "methods/kit/octree/voxel_cloud.h"

namespace dustbench::octree {

/// How voxels are drawn.
enum class Render {
    billboards,  ///< smoothly faded circles of the voxel's optical depth
    circles,     ///< as in the paper: circles with the voxel's opacity at the centre
    cubes,       ///< six faces
    raycast,     ///< ray marching through the tree
};
inline constexpr Choices<Render> renders{{"billboards", Render::billboards},
                                         {"circles", Render::circles},
                                         {"cubes", Render::cubes},
                                         {"raycast", Render::raycast}};

struct DustSettings {
    OctreeSettings tree;
    Render render = Render::billboards;
    draw::SortKind sort = draw::SortKind::radix;
    draw::OpacityFrom opacity = draw::OpacityFrom::dust;
    double youngOpacity = 0.5;
    draw::NoiseSettings noise{};
    bool crossFade = false;
    double crossFadeSeconds = 0.1;
    double keepSeconds = 0;        ///< 0: a tree for every frame
    double worldEdgeMetres = 128;  ///< of the smallest world
    bool worldGrows = true;        ///< doubled, with one more level, until it holds all particles
};

/// Adds the parameters above to the method's parameters, and the facts that OctreeDust reports.
DUSTBENCH_API void declareDust(MethodInfo& info);
/// Adds only the facts.
DUSTBENCH_API void declareDustFacts(MethodInfo& info);
/// Adds `layout`, the builder, and `mode`, whose word `paper` is a preset of all these parameters. `help` explains the
/// layouts.
DUSTBENCH_API void declareLayout(MethodInfo& info, const std::string& help);
/// Throws InputError if the values are inconsistent.
[[nodiscard]] DUSTBENCH_API DustSettings dustSettings(const ParameterValues& values);

/// Edge of a voxel per radius of the billboard that shows it.
[[nodiscard]] DUSTBENCH_API float edgesPerDrawnRadius(Render render);

/// Dust whose voxels have an opacity by age alone, independent of their size: Carr2006, 3.2.
///
/// A particle's opacity is α by age. Its radius is that of a puff whose mass, spread over its voxel, has the optical
/// depth τ = −ln(1 − α) along an axis: τ·2π(r/2)² = τ·edge². All other code works as for any dust. Owns two columns,
/// booked on a ledger.
class VoxelOpacity {
 public:
    VoxelOpacity(MemoryLedger& ledger, double youngOpacity)
        : opacities_(ledger.account("opacities by age"), youngOpacity), radii_(ledger.account("opacities by age")) {}

    /// The same particles with new opacities and radii, in the same voxels; valid until the next call.
    Puffs of(const Puffs& dust, const Lattice& lattice, const OctreeSettings& settings);

 private:
    draw::AgeOpacity opacities_;
    LedgerVector<float> radii_;
};

/// Optical masses after a frame, m².
struct ShownMass {
    const Puffs& dust;
    const Lattice& lattice;
    std::span<const float> built, shown;  ///< of the voxels in the tree, and of those drawn
};
/// Sets the facts `mass_kept` and `mass_lost`.
DUSTBENCH_API void reportMass(const ShownMass& mass, const DustSettings& settings, Facts& facts);

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
    /// The voxels to draw.
    [[nodiscard]] const VoxelCloud& shown() const { return *shown_; }

 private:
    void build(const Frame& frame);
    void chooseVoxels(const Frame& frame);
    void uploadBillboards(std::span<const std::uint32_t> order);
    void uploadCubes(std::span<const std::uint32_t> order);
    void uploadTree();
    [[nodiscard]] float noiseFactor(const VoxelCloud& cloud, std::size_t i) const;

    DustSettings settings_;
    MemoryLedger ledger_;
    std::unique_ptr<OctreeBuilder> builder_;
    Octree tree_;
    Octree shownTree_;  ///< tree of the faded voxels, used only for ray marching
    VoxelCloud cloud_;
    std::optional<VoxelOpacity> byAge_;
    std::optional<KeptVoxels> kept_;
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
