#include "methods/voxel_shape/voxel_shape.h"

#include <algorithm>

#include "methods/contract/volume.h"
#include "methods/kit/files/data_folder.h"
#include "methods/voxel_shape/shape_builder.h"
#include "methods/voxel_shape/shape_file.h"

namespace dustbench::voxel_shape {
namespace {

/// Shapes of the data folder by name; `car` is one of them even where its file is missing, which is then said on use.
std::vector<std::string> shapeNames() {
    std::vector<std::string> names = files::listData("shapes", ".toml");
    if (std::ranges::find(names, "car") == names.end()) names.emplace_back("car");
    return names;
}

/// Leaves a choice to the shape's file.
constexpr const char* preset = "preset";

template <typename Enumeration>
std::vector<std::string> presetOr(const Choices<Enumeration>& choices) {
    std::vector<std::string> words = choices.words();
    words.insert(words.begin(), preset);
    return words;
}

/// What a parameter with the choices `presetOr(choices)` names, or `initial`.
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
    shape.voxeliser = unlessPreset(values, "voxeliser", voxelisers, shape.voxeliser);
    Look& look = shape.look;
    look.render = unlessPreset(values, "render", renders, look.render);
    if (values.choice("blend") != preset) look.additive = values.choice("blend") == "additive";
    look.order = unlessPreset(values, "sort", orders, look.order);
    look.nearest = static_cast<std::uint32_t>(values.integer("sort_nearest"));
    look.every = static_cast<std::uint32_t>(values.integer("sort_every"));
    if (values.real("sprite_pixels") > 0) look.pixels = static_cast<float>(values.real("sprite_pixels"));
    return shape;
}

}  // namespace

VoxelShape::VoxelShape(const Shape& shape) : shape_(shape), track_(shape.track), order_(ledger_) {}

void VoxelShape::prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) {
    system_.emplace(buildShape(ledger_, shape_, scene, device, setup.seed));
    if (shape_.collides && !scene.solids.empty()) {
        double scale = 0;
        for (const TrackKey& key : shape_.track.keys) scale = std::max(scale, key.scale);
        const float voxel = system_->grid().lattice().edgeMetres * static_cast<float>(scale);
        collision_.emplace(scene, voxel, shape_.impact);
    }
    shape_.motion.wind = shape_.windFactor * scene.wind;
    picture_.emplace(device, shape_.look);
}

void VoxelShape::update(const Frame& frame) {
    {
        const auto timing = frame.clock.measure(Stage::simulate);
        const Pose pose = track_.advance(frame.state, frame.stepSeconds);
        simulate(frame, pose);
    }
    const particles::ParticleStore& store = system_->particles().store;
    std::span<const std::uint32_t> order;
    {
        const auto timing = frame.clock.measure(Stage::sort);
        order = order_.of(shape_.look, {store.x, store.y, store.z}, glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    picture_->upload(system_->particles(), order);
}

void VoxelShape::simulate(const Frame& frame, const Pose& pose) {
    const auto seconds = static_cast<float>(frame.stepSeconds);
    {
        const auto timing = frame.clock.measureDetail("move");
        system_->live(shape_.motion, seconds);
    }
    if (collision_) {
        const auto timing = frame.clock.measureDetail("collide");
        collision_->stopParticles(system_->particles(), seconds);
    }
    // From here on particles and voxels are those of `pose`: nothing is born where the shape is in a solid by now.
    if (collision_) {
        const auto timing = frame.clock.measureDetail("switch voxels");
        collision_->switchVoxels(system_->grid(), pose);
    }
    const auto timing = frame.clock.measureDetail("replace");
    system_->replace(pose, shape_.motion, seconds);
}

void VoxelShape::draw(const Frame& frame, gpu::Layer& layer) {
    picture_->draw(frame.view, layer);
}

void VoxelShape::volume(const Frame&, VolumeVisitor& visitor) const {
    visitor.puffs(system_->particles().store);
}

MemoryReport VoxelShape::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    if (collision_)
        for (const MemoryUse& use : collision_->memory()) report.push_back(use);
    if (picture_) report.push_back({"picture", 0, picture_->gpuBytes()});
    return report;
}

std::int64_t VoxelShape::primitives() const {
    return picture_ ? static_cast<std::int64_t>(picture_->count()) : 0;
}

std::optional<std::uint64_t> VoxelShape::stateHash() const {
    return system_ ? system_->stateHash() : 0;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Voxel-shaped particles";
    info.summary = "A mesh becomes a grid of voxels that say how the particles in them look and move.";
    info.source = "JuckelBeckhaus2007";
    info.parameters
        .choice("shape", "car", shapeNames(), "which file of data/shapes: what is made of particles, and how")
        .integer("shape_particles", 0, 0, 10'000'000, "", "particles that the shape holds; 0: as its file says")
        .integer("resolution", 0, 0, maximumVoxelsASide, "voxels",
                 "along the mesh's longest side; 0: as the shape's file says")
        .choice("voxeliser", preset, presetOr(voxelisers),
                "every voxel that the surface touches, by the CPU; the paper's slices, by the GPU; or slices along all "
                "axes")
        .choice("render", preset, presetOr(renders), "what a particle is drawn as")
        .real("sprite_pixels", 0, 0, 255, "pixels", "width of points and sprites; 0: as the shape's file says")
        .choice("blend", preset, {preset, "alpha", "additive"}, "cover what is behind, or add light to it")
        .choice(
            "sort", preset, presetOr(orders),
            "far to near, by a radix sort or the paper's quicksort; the nearest ones alone; every few frames; or not")
        .integer("sort_nearest", 2000, 0, 10'000'000, "", "how many sort=nearest sorts")
        .integer("sort_every", 4, 1, 1000, "frames", "how often sort=every sorts");
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<VoxelShape>(shapeOf(values));
    };
    info.cannotTake = [](const scene::Scene& scene) {
        return scene.vehicle ? std::string() : std::string("needs a vehicle, which shapes are made of or follow");
    };
    return info;
}

}  // namespace dustbench::voxel_shape
