#include "methods/voxel_shape/voxel_shape.h"

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/contract/volume.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/maths/hash.h"
#include "methods/voxel_shape/particles/draw_along.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_builder.h"
#include "methods/voxel_shape/silhouette.h"

namespace dustbench::voxel_shape {
namespace {

/// Returns the names of the shapes in the data folder. Always lists `car`, so that a missing file is reported on use.
std::vector<std::string> shapeNames() {
    std::vector<std::string> names = files::listData("shapes", ".toml");
    if (std::ranges::find(names, "car") == names.end()) names.emplace_back("car");
    return names;
}

/// The choice that leaves a setting to the shape's file.
constexpr const char* preset = "preset";

template <typename Enumeration>
std::vector<std::string> presetOr(const Choices<Enumeration>& choices) {
    std::vector<std::string> words = choices.words();
    words.insert(words.begin(), preset);
    return words;
}

/// Returns the value that a parameter with the choices `presetOr(choices)` selects, or `initial` for `preset`.
template <typename Enumeration>
Enumeration unlessPreset(const ParameterValues& values, const char* name, const Choices<Enumeration>& choices,
                         Enumeration initial) {
    const std::string& word = values.choice(name);
    return word == preset ? initial : choices.valueOf(word);
}

Shape shapeOf(const ParameterValues& values) {
    Shape shape = readShape(files::findData("shape", "shapes", values.choice("shape"), ".toml"));
    if (const auto resolution = values.integer("resolution"); resolution > 0)
        shape.resolution = static_cast<int>(resolution);
    if (const auto particles = values.integer("shape_particles"); particles > 0)
        shape.particles = static_cast<std::uint32_t>(particles);
    if (values.choice("mode", modes) == Mode::paper) {
        shape.voxeliser = Voxeliser::slices;
        shape.motion.fullVoxelsRefuse = false;
        for (Shape& other : shape.others) other.motion.fullVoxelsRefuse = false;
    }
    if (const auto each = values.integer("particles_per_voxel"); each > 0)
        shape.voxels.maximumDensity = static_cast<std::uint32_t>(each);
    if (values.real("fill_seconds") >= 0) shape.motion.fillSeconds = static_cast<float>(values.real("fill_seconds"));
    shape.voxeliser = unlessPreset(values, "voxeliser", voxelisers, shape.voxeliser);
    if (shape.fill == Fill::solid && shape.voxeliser != Voxeliser::conservative)
        throw InputError("shape '" + shape.name + "': fill = \"solid\" needs voxeliser=conservative; got " +
                         std::string(voxelisers.wordOf(shape.voxeliser)));
    shape.collidesWith = unlessPreset(values, "collide", collidables, shape.collidesWith);
    for (Shape& other : shape.others)
        other.collidesWith = unlessPreset(values, "collide", collidables, other.collidesWith);
    shape.heldWithin = values.real("held_within");
    Look& look = shape.look;
    look.render = unlessPreset(values, "render", renders, look.render);
    if (values.choice("blend") != preset) look.additive = values.choice("blend") == "additive";
    look.order = unlessPreset(values, "sort", orders, look.order);
    look.nearest = static_cast<std::uint32_t>(values.integer("sort_nearest"));
    look.every = static_cast<std::uint32_t>(values.integer("sort_every"));
    if (values.real("sprite_pixels") >= 0) look.pixels = static_cast<float>(values.real("sprite_pixels"));
    return shape;
}

}  // namespace

VoxelShape::VoxelShape(const Shape& shape) : order_(ledger_), merged_(ledger_) {
    shapes_.emplace_back(shape);
    for (const Shape& other : shape.others) shapes_.emplace_back(other);
}

void VoxelShape::prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) {
    scene_ = &scene;
    device_ = &device;
    // Each shape gets its own seed.
    for (std::size_t i = 0; i < shapes_.size(); ++i)
        shapes_[i].prepare(ledger_, scene, device, setup.seed ^ (i * 0x9e3779b97f4a7c15ULL));
    picture_ = std::make_unique<ShapePicture>(device, shapes_.front().shape().look);
}

void VoxelShape::update(const Frame& frame) {
    {
        const auto timing = frame.clock.measure(Stage::simulate);
        simulate(frame);
    }
    const ShapeParticles& particles = merged_.of(shapes_);
    const particles::ParticleStore& store = particles.store;
    std::span<const std::uint32_t> order;
    {
        const auto timing = frame.clock.measure(Stage::sort);
        order = order_.of(shapes_.front().shape().look, {store.x, store.y, store.z}, glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    picture_->upload(particles, order);
}

void VoxelShape::simulate(const Frame& frame) {
    for (LivingShape& shape : shapes_) shape.step(frame);
    if (shapes_.size() == 1) return;
    // All shapes are at the frame's time now.
    const auto timing = frame.clock.measureDetail("cross");
    const float rate = shapes_.front().shape().drawnAlongPerSecond;
    const float share = 1 - std::exp(-rate * static_cast<float>(frame.stepSeconds));
    for (LivingShape& moved : shapes_)
        for (const LivingShape& by : shapes_)
            if (&moved != &by) drawAlong(moved.system(), by.system(), share);
}

void VoxelShape::draw(const Frame& frame, gpu::Layer& layer) {
    picture_->draw(frame.view, layer);
}

void VoxelShape::volume(const Frame&, VolumeVisitor& visitor) const {
    for (const LivingShape& shape : shapes_) visitor.puffs(shape.system().particles().store);
}

ShapeCount VoxelShape::count() const {
    ShapeCount sum;
    for (const LivingShape& shape : shapes_) {
        const ShapeCount own = shape.system().count();
        sum.inside += own.inside;
        sum.fading += own.fading;
        sum.room += own.room;
    }
    return sum;
}

void VoxelShape::report(const Frame& frame, Facts& facts) const {
    for (const LivingShape& shape : shapes_) shape.requireNumberHeld();
    const ShapeCount counted = count();
    facts.set("inside", static_cast<std::int64_t>(counted.inside));
    facts.set("fading", static_cast<std::int64_t>(counted.fading));
    if (!facts.wants("silhouette_iou")) return;
    if (const auto overlap = silhouetteOverlap(frame.view)) facts.set("silhouette_iou", *overlap);
}

std::optional<double> VoxelShape::silhouetteOverlap(const scene::View& view) const {
    const Shape& shape = shapes_.front().shape();
    if (shapes_.size() > 1 || (shape.source != Source::mesh && shape.source != Source::vehicle)) return std::nullopt;
    gpu::Texture nothing =
        gpu::Texture::make2D(*device_, "empty depth", gpu::Format::depth32F, view.width, view.height);
    const std::vector<float> farthest(static_cast<std::size_t>(view.width * view.height), 0.0f);
    nothing.write(std::span<const float>(farthest));
    gpu::Layer layer(*device_, nothing);
    layer.clear();
    picture_->draw(view, layer);
    return overlapOf(silhouetteOf(meshOf(shape, *scene_), system().pose(), view), draw::readBack(layer.colour()));
}

MemoryReport VoxelShape::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    for (const LivingShape& shape : shapes_)
        for (const MemoryUse& use : shape.memory()) report.push_back(use);
    if (picture_) report.push_back({"picture", 0, picture_->gpuBytes()});
    return report;
}

std::int64_t VoxelShape::primitives() const {
    return picture_ ? static_cast<std::int64_t>(picture_->count()) : 0;
}

std::optional<std::uint64_t> VoxelShape::stateHash() const {
    if (!picture_) return 0;
    if (shapes_.size() == 1) return system().stateHash();
    maths::Hash hash;
    for (const LivingShape& shape : shapes_) hash.add(shape.system().stateHash());
    return hash.value();
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Voxel-shaped particles";
    info.summary = "Voxelises a mesh; each voxel determines how the particles in it look and move.";
    info.source = "JuckelBeckhaus2007";
    info.takesLights = true;
    info.parameters.dataFile("shape", "car", "shapes", ".toml", shapeNames(), "the shape made of particles")
        .integer("shape_particles", 0, 0, 10'000'000, "", "particles that the shape holds; 0: as in its file")
        .integer("particles_per_voxel", 0, 0, 100'000, "",
                 "particles that each voxel holds; 0: its share of the shape's, or as in the file")
        .real("fill_seconds", -1, -1, 100, "s",
              "time in which voxels replace missing particles; 0: at once; negative: as in the shape's file")
        .integer("resolution", 0, 0, maximumVoxelsASide, "voxels",
                 "voxels along the mesh's longest side; 0: as in the shape's file")
        .choice("mode", Mode::fixed, modes,
                "fixed: no voxel holds more than its maximum density; paper: the maximum density limits births only, "
                "and the mesh is voxelised by slices")
        .choice("voxeliser", preset, presetOr(voxelisers),
                "every voxel that the surface touches (CPU); the paper's slices along z (GPU); or slices along all "
                "axes; preset: as in the shape's file, with mode=paper slices")
        .choice("collide", preset, presetOr(collidables),
                "collides with the scene's solids, with the vehicle, or with both; preset: as in the shape's file")
        .choice("render", preset, presetOr(renders), "how a particle is drawn")
        .real("sprite_pixels", -1, -1, 255, "pixels",
              "width of points and sprites; 0: the size of the particles; negative: as in the shape's file")
        .choice("blend", preset, {preset, "alpha", "additive"}, "alpha: cover the background; additive: add light")
        .choice("sort", preset, presetOr(orders),
                "far to near by a radix sort or the paper's quicksort; only the nearest; every few frames; or never")
        .integer("sort_nearest", 2000, 0, 10'000'000, "", "number of particles that sort=nearest sorts")
        .integer("sort_every", 4, 1, 1000, "frames", "interval at which sort=every sorts")
        .real("held_within", 0, 0, 1, "share",
              "maximum relative deviation of the particles held from the shape's number; a run that exceeds it "
              "fails; 0: unchecked");
    info.facts = {
        {"fading", "particles", FactOver::maximumOfFrames,
         "fading particles, outside the shape's voxels or waiting at a full one: maximum of the recorded frames"},
        {"inside", "particles", FactOver::lastFrame, "particles that the shape's voxels hold after the last frame"},
        {"silhouette_iou", "share", FactOver::lastFrame,
         "intersection over union of the pixels that particles cover by more than half and those the mesh covers: "
         "after the last frame; empty if the shape has no mesh"}};
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<VoxelShape>(shapeOf(values));
    };
    info.cannotTake = [](const scene::Scene& scene) -> std::string {
        return scene.vehicle ? "" : "needs a vehicle, whose mesh or motion shapes use";
    };
    return info;
}

}  // namespace dustbench::voxel_shape
