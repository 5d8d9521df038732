#include "methods/kit/octree/octree_dust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/volume.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/octree/cell_kernel.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/particle_cells.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

constexpr std::size_t voxelsPerBlock = 16'384;
/// Keeps a billboard's opacity below 1, where the optical depth is infinite.
constexpr float maximumOpacity = 0.99999f;
/// Radius of a voxel's circle by its edge: that of the voxel's circumscribed sphere, so that circles of neighbours
/// leave no gap. The paper does not state it.
constexpr float circleOfEdge = 0.8660254f;
/// A billboard's half-side by its radius (draw/billboards.h).
constexpr float halfSideOfRadius = 1.5f;
/// Minimum distance between the vehicle and the faces of the world, as a fraction of the world's edge.
constexpr double vehicleMargin = 1.0 / 8;

/// Extent of the particles along an axis.
struct Extent {
    double minimum, maximum;
    [[nodiscard]] double middle() const { return 0.5 * (minimum + maximum); }
};
using Extents = std::array<Extent, 3>;

/// Ignores NaN. Without numbers: infinity and −infinity.
Extent extentOf(std::span<const float> values) {
    // Independent lanes, so that the comparisons do not wait for each other.
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> minimum, maximum;
    minimum.fill(std::numeric_limits<float>::infinity());
    maximum.fill(-std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < values.size(); i += lanes) {
        const std::size_t here = std::min(lanes, values.size() - i);
        for (std::size_t lane = 0; lane < here; ++lane) {
            const float value = values[i + lane];
            minimum[lane] = value < minimum[lane] ? value : minimum[lane];
            maximum[lane] = value > maximum[lane] ? value : maximum[lane];
        }
    }
    return {static_cast<double>(*std::ranges::min_element(minimum)),
            static_cast<double>(*std::ranges::max_element(maximum))};
}

/// Centre of the world. A trail is behind its vehicle, so the world is centred on the dust but keeps the vehicle
/// inside.
glm::dvec3 worldMiddle(const Extents& dust, const glm::dvec3& vehicle, double edgeMetres) {
    const double farthest = (0.5 - vehicleMargin) * edgeMetres;
    const auto along = [farthest](const Extent& extent, double vehicleAt) {
        const double middle = extent.middle();
        return std::isfinite(middle) ? std::clamp(middle, vehicleAt - farthest, vehicleAt + farthest) : vehicleAt;
    };
    return {along(dust[0], vehicle.x), vehicle.y, along(dust[2], vehicle.z)};
}

bool holds(const Lattice& lattice, const Extents& dust) {
    for (int axis = 0; axis < 3; ++axis)
        if (dust[static_cast<std::size_t>(axis)].minimum < lattice.origin[axis] ||
            dust[static_cast<std::size_t>(axis)].maximum >= lattice.origin[axis] + lattice.edgeMetres)
            return false;
    return true;
}

/// The smallest world that contains all particles, starting from the given edge: each is twice as wide as the previous
/// one and has one more level, so that voxels keep their size and position. The widest has `maximumDepth` levels.
Lattice latticeOver(const Puffs& dust, const glm::dvec3& vehicle, const DustSettings& settings) {
    const Extents extents{extentOf(dust.x), extentOf(dust.y), extentOf(dust.z)};
    Lattice lattice;
    lattice.edgeMetres = settings.worldEdgeMetres;
    lattice.depth = settings.tree.depth;
    const double step = lattice.cellEdgeMetres(lattice.depth - settings.tree.levels + 1);
    for (;; lattice.edgeMetres *= 2, ++lattice.depth) {
        lattice.origin = octreeWorldOrigin(worldMiddle(extents, vehicle, lattice.edgeMetres), lattice.edgeMetres, step);
        if (!settings.worldGrows || lattice.depth == maximumDepth || holds(lattice, extents)) return lattice;
    }
}

double massOf(const Puffs& dust, std::size_t i) {
    return maths::puffMassSquareMetres(static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]));
}

}  // namespace

Puffs VoxelOpacity::of(const Puffs& dust, const Lattice& lattice, const OctreeSettings& settings) {
    const ParticlePlace place(dust, lattice, settings);
    radii_.resize(dust.size());
    for (std::size_t i = 0; i < dust.size(); ++i)
        radii_[i] = static_cast<float>(lattice.cellEdgeMetres(place.level(i))) / edgePerRadius;
    Puffs shown = dust;
    shown.opacity = opacities_.of(dust);
    shown.radius = radii_;
    return shown;
}

OctreeBuilder::~OctreeBuilder() = default;

void declareDust(MethodInfo& info) {
    declareOctreeParameters(info.parameters);
    info.parameters
        .choice("render", Render::billboards, renders,
                "how voxels are drawn: smoothly faded circles of their optical depth, the paper's plain circles, six "
                "faces, or ray marching through the tree")
        .choice("sort", draw::SortKind::radix, draw::sortKinds,
                "order in which billboards and cubes are blended: far to near by the paper's quicksort or by a radix "
                "sort, or in tree order")
        .boolean("crossfade", false, "fade voxels in and out instead of letting them pop")
        .real("crossfade_time", 0.1, 0.001, 10, "s", "time constant of that fading")
        .real("keep_time", 0, 0, 10, "s",
              "time for which a tree is kept; voxels are interpolated between the last two trees, so they are as much "
              "late. 0: a tree for every frame")
        .real("world_edge", 128, 1, 1e5, "m",
              "edge of the octree's world, a cube that follows the vehicle; doubled, with one more level, until it "
              "holds the dust or has 12 levels");
    draw::declareOpacity(info.parameters);
    draw::declareNoise(info.parameters);
    declareDustFacts(info);
    info.facts.push_back({"mass_lost",
                          "share",
                          FactOver::lastFrame,
                          "share of the optical mass that the method's rule keeps and its volume does not hold, after "
                          "the last frame",
                          {.maximum = 0.01}});
    info.facts.push_back(
        {"world_edge_max", "m", FactOver::maximumOfFrames,
         "edge of the octree's world, doubled until it holds the dust: maximum of the recorded frames"});
}

void declareDustFacts(MethodInfo& info) {
    info.facts.push_back({"clipped",
                          "particles",
                          FactOver::maximumOfFrames,
                          "particles outside the method's world: maximum of the recorded frames",
                          {.maximum = 0}});
    info.facts.push_back({"mass_kept", "share", FactOver::lastFrame,
                          "share of the particles' optical mass that the method's volume holds after the last frame; "
                          "dust outside of the volume's box is missing from it"});
    info.facts.push_back(
        {"structure_bytes", "bytes", FactOver::maximumOfFrames,
         "bytes of the structure that holds the voxels, an octree's nodes and voxels or a grid's cells: "
         "maximum of the recorded frames"});
}

void declareLayout(MethodInfo& info, const std::string& help) {
    info.parameters.choice("layout", "faithful", {"faithful", "morton", "paper", "gpu"}, help)
        .choice("mode", "fixed", {"fixed", "paper"}, "fixed: the optical model; paper: built and drawn as in the paper")
        .preset("mode", "paper",
                {{"layout", "paper"}, {"opacity", "age"}, {"render", "circles"}, {"sort", "quicksort"}});
}

DustSettings dustSettings(const ParameterValues& values) {
    DustSettings settings;
    settings.tree = octreeSettings(values);
    settings.render = values.choice("render", renders);
    settings.sort = values.choice("sort", draw::sortKinds);
    settings.opacity = values.choice("opacity", draw::opacityOrigins);
    settings.youngOpacity = values.real("young_opacity");
    settings.noise = draw::noiseSettings(values);
    settings.crossFade = values.boolean("crossfade");
    settings.crossFadeSeconds = values.real("crossfade_time");
    settings.keepSeconds = values.real("keep_time");
    settings.worldEdgeMetres = values.real("world_edge");
    return settings;
}

float edgesPerDrawnRadius(Render render) {
    return render == Render::circles ? halfSideOfRadius / circleOfEdge : edgePerRadius;
}

OctreeDust::OctreeDust(const DustSettings& settings, const MakeBuilder& makeBuilder)
    : settings_(settings),
      builder_(makeBuilder(ledger_)),
      tree_(ledger_),
      shownTree_(ledger_),
      cloud_(ledger_),
      sort_(ledger_),
      extinctions_(ledger_.account("voxel list")),
      colours_(ledger_.account("voxel list")) {
    if (settings.opacity == draw::OpacityFrom::age) byAge_.emplace(ledger_, settings.youngOpacity);
    if (settings.keepSeconds > 0) kept_.emplace(ledger_, settings.keepSeconds);
    if (settings.crossFade) fade_.emplace(ledger_, settings.crossFadeSeconds);
}

void OctreeDust::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    tree_.clear(settings_.tree.depth);
    switch (settings_.render) {
        case Render::billboards:
        case Render::circles:
            billboards_.emplace(device, draw::BillboardStyle{.plainAlpha = settings_.render == Render::circles,
                                                             .noise = settings_.noise.amplitude});
            break;
        case Render::cubes:
            cubes_.emplace(device);
            break;
        case Render::raycast:
            march_.emplace(device);
            break;
    }
}

void OctreeDust::build(const Frame& frame) {
    const Lattice lattice = latticeOver(frame.dust, frame.state.vehicle.position, settings_);
    OctreeSettings tree = settings_.tree;
    tree.depth = lattice.depth;
    const Puffs dust = byAge_ ? byAge_->of(frame.dust, lattice, tree) : frame.dust;
    {
        const auto detail = frame.clock.measureDetail("tree");
        clipped_ = builder_->build(dust, lattice, tree, tree_);
    }
    {
        const auto detail = frame.clock.measureDetail("list");
        cloud_.take(tree_, dust, VoxelRule(dust, settings_.tree.policy), lattice, settings_.noise);
    }
}

void OctreeDust::chooseVoxels(const Frame& frame) {
    shown_ = &cloud_;
    if (kept_) {
        const bool due = kept_->advance(frame.stepSeconds);
        if (due) build(frame);
        const auto detail = frame.clock.measureDetail("interpolate");
        if (due) kept_->take(cloud_);
        shown_ = &kept_->between();
    } else {
        build(frame);
    }
    if (!fade_) return;
    const auto detail = frame.clock.measureDetail("crossfade");
    shown_ = &fade_->follow(*shown_, frame.stepSeconds);
}

void OctreeDust::update(const Frame& frame) {
    chooseVoxels(frame);
    if (settings_.render == Render::raycast) {
        const auto timing = frame.clock.measure(Stage::upload);
        uploadTree();
        return;
    }
    std::span<const std::uint32_t> order;
    {
        const auto timing = frame.clock.measure(Stage::sort);
        order = sort_.farToNear(settings_.sort, {shown().x, shown().y, shown().z}, glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    if (settings_.render == Render::cubes)
        uploadCubes(order);
    else
        uploadBillboards(order);
}

/// r = edge/√(π/2) and τ = mass/edge²: a Gaussian puff with the voxel's mass and optical depth. For a plain circle: the
/// opacity at its centre, and the size of the voxel.
void OctreeDust::uploadBillboards(std::span<const std::uint32_t> order) {
    const VoxelCloud& cloud = shown();
    const draw::InstanceLayout layout = billboards_->layout(cloud.coloured());
    const std::span<float> memory = billboards_->map(order.size(), layout);
    const float edgesPerRadius = edgesPerDrawnRadius(settings_.render);
    parallel::forEachBlock(order.size(), voxelsPerBlock, [&](std::size_t first, std::size_t count) {
        float* value = memory.data() + first * layout.floats;
        for (std::size_t k = first; k < first + count; ++k) {
            const std::uint32_t i = order[k];
            *value++ = cloud.x[i];
            *value++ = cloud.y[i];
            *value++ = cloud.z[i];
            *value++ = cloud.edge[i] / edgesPerRadius;
            *value++ = std::min(-std::expm1(-cloud.opticalDepth(i)), maximumOpacity);
            if (billboards_->noisy()) {
                const auto& [noise, metres] = cloud.noise[i];
                for (const float each : {noise.x, noise.y, noise.z, metres}) *value++ = each;
            }
            if (!layout.coloured) continue;
            *value++ = cloud.red[i];
            *value++ = cloud.green[i];
            *value++ = cloud.blue[i];
        }
    });
    billboards_->unmap();
}

/// For voxels of one density: the noise at their centre.
float OctreeDust::noiseFactor(const VoxelCloud& cloud, std::size_t i) const {
    return cloud.noise.empty() ? 1 : 1 + settings_.noise.amplitude * draw::plainNoise(cloud.noise[i].place);
}

void OctreeDust::uploadCubes(std::span<const std::uint32_t> order) {
    const VoxelCloud& cloud = shown();
    const draw::InstanceLayout layout = draw::Cubes::layout(cloud.coloured());
    const std::span<float> memory = cubes_->map(order.size(), layout);
    parallel::forEachBlock(order.size(), voxelsPerBlock, [&](std::size_t first, std::size_t count) {
        float* value = memory.data() + first * layout.floats;
        for (std::size_t k = first; k < first + count; ++k) {
            const std::uint32_t i = order[k];
            *value++ = cloud.x[i];
            *value++ = cloud.y[i];
            *value++ = cloud.z[i];
            *value++ = cloud.edge[i];
            *value++ = cloud.opticalDepth(i) * noiseFactor(cloud, i);
            if (!layout.coloured) continue;
            *value++ = cloud.red[i];
            *value++ = cloud.green[i];
            *value++ = cloud.blue[i];
        }
    });
    cubes_->unmap();
}

void OctreeDust::uploadTree() {
    const VoxelCloud& cloud = shown();
    const Octree* tree = &tree_;
    if (fade_ || kept_) {  // fading voxels are not in the tree
        shownTree_.clear(cloud.lattice.depth);
        for (std::size_t i = 0; i < cloud.size(); ++i)
            shownTree_.makeNode(cloud.code(i), cloud.rise(i)).voxel = static_cast<std::uint32_t>(i + 1);
        tree = &shownTree_;
    }
    extinctions_.resize(cloud.size());
    colours_.resize(cloud.coloured() ? cloud.size() : 0);
    for (std::size_t i = 0; i < cloud.size(); ++i)
        extinctions_[i] = cloud.extinctionPerMetre(i) * noiseFactor(cloud, i);
    for (std::size_t i = 0; i < colours_.size(); ++i) colours_[i] = {cloud.red[i], cloud.green[i], cloud.blue[i]};
    march_->upload({cloud.lattice, tree->blocks(), extinctions_, colours_});
}

void OctreeDust::draw(const Frame& frame, gpu::Layer& layer) {
    if (billboards_) billboards_->draw(frame.view, frame.dust.colourOfAll, layer);
    if (cubes_) cubes_->draw(frame.view, frame.dust.colourOfAll, layer);
    if (march_) march_->draw(frame.view, frame.dust.colourOfAll, layer);
}

void OctreeDust::volume(const Frame&, VolumeVisitor& visitor) const {
    const VoxelCloud& cloud = shown();
    std::vector<OctreeVoxel> voxels;
    voxels.reserve(cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const glm::uvec3 cell = mortonCell(cloud.code(i)) >> static_cast<unsigned>(cloud.rise(i));
        voxels.push_back(
            {cell.x, cell.y, cell.z, cloud.lattice.depth - cloud.rise(i), cloud.extinctionPerMetre(i), cloud.age[i]});
    }
    visitor.octree({cloud.lattice.origin, cloud.lattice.edgeMetres, cloud.lattice.depth, voxels});
}

void reportMass(const ShownMass& mass, const DustSettings& settings, Facts& facts) {
    const Puffs& dust = mass.dust;
    double ofParticles = 0, outside = 0, built = 0, ofShown = 0;
    for (std::size_t i = 0; i < dust.size(); ++i) {
        ofParticles += massOf(dust, i);
        if (!holds(mass.lattice,
                   {Extent{dust.x[i], dust.x[i]}, Extent{dust.y[i], dust.y[i]}, Extent{dust.z[i], dust.z[i]}}))
            outside += massOf(dust, i);
    }
    if (!(ofParticles > 0)) return;
    for (const float each : mass.built) built += static_cast<double>(each);
    for (const float each : mass.shown) ofShown += static_cast<double>(each);
    facts.set("mass_kept", ofShown / ofParticles);
    // With the other policies a voxel keeps only one of its particles; opacity by age alone does not conserve mass.
    const bool keepsAll =
        settings.tree.policy == OpacityPolicy::accumulate && settings.opacity == draw::OpacityFrom::dust;
    if (settings.worldGrows && settings.keepSeconds == 0)  // a kept tree holds dust of another time
        facts.set("mass_lost", keepsAll ? std::abs(1 - built / ofParticles) : outside / ofParticles);
}

void OctreeDust::report(const Frame& frame, Facts& facts) const {
    facts.set("clipped", clipped_);
    facts.set("structure_bytes", static_cast<std::int64_t>(builder_->structureBytes(tree_)));
    if (settings_.worldGrows) facts.set("world_edge_max", shown().lattice.edgeMetres);
    if (facts.wants("mass_kept"))
        reportMass({frame.dust, shown().lattice, cloud_.mass, shown().mass}, settings_, facts);
}

MemoryReport OctreeDust::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    if (billboards_) report.push_back({"billboards", 0, billboards_->gpuBytes()});
    if (cubes_) report.push_back({"cubes", 0, cubes_->gpuBytes()});
    if (march_) report.push_back({"octree march", march_->cpuBytes(), march_->gpuBytes()});
    return report;
}

}  // namespace dustbench::octree
