// Makes every shader program by drawing with every setting that selects one. Over 400 lines: the settings of all
// methods.
#include "tests/shaders/captured_programs.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "bench/selfcheck/machine_checks.h"
#include "bench/view/split_view.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/layer_blend.h"
#include "methods/kit/draw/opaque_scene.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/sort/radix_sort.h"
#include "methods/kit/gpu/sort/scan.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::shaders {
namespace {

using Values = std::map<std::string, std::string>;

constexpr int width = 32, height = 24, frames = 2;

/// Parameter values that select shaders. All values of choices and switches are tried without being listed here.
const std::map<std::string, std::vector<std::string>> decidingValues{
    {"shadow_cells", {"0", "2"}},
    {"vorticity", {"0", "2"}},
    {"rank", {"2", "4"}},
    {"scheme", {"ours"}},  // the demo needs a fixed box, see below
    {"at",
     {"0s:render.part=points", "0s:render.part=points;0s:render.round=on",
      "0s:render.part=points;0s:render.blend=alpha", "0s:render.part=lines",
      "0s:render.part=lines;0s:render.fade=off;0s:render.blend=alpha", "0s:render.part=lines;0s:render.blend=alpha",
      "0s:render.part=curves", "0s:render.part=curves;0s:render.fade=off;0s:render.blend=alpha",
      "0s:render.part=curves;0s:render.blend=alpha", "0s:render.part=hybrid;0s:render.stereo=on",
      "0s:render.part=sprites", "0s:render.part=sprites;0s:render.blend=alpha",
      "0s:render.part=sprites;0s:render.picture=puff", "0s:render.part=aa_sprites",
      "0s:render.part=aa_sprites;0s:render.blend=alpha;0s:render.picture=puff",
      "0s:render.part=aa_sprites;0s:render.by=accumulation", "0s:render.part=objects",
      "0s:render.part=objects;0s:render.along_velocity=on", "0s:render.blend=additive"}}};

/// Small values, so that a combination takes milliseconds, for methods with such parameters.
const Values small{{"grid", "16x16x16"}, {"shape_particles", "300"}, {"depth", "5"}};

/// Parameters that select the same shaders: all their combinations are tried, with other parameters fixed.
struct Product {
    std::string method;
    Values fixed;
    std::vector<std::string> parameters;
    bool showsDust = false;  ///< then the dust's colours also select shaders
};
const std::vector<Product> products{
    {"billboard", {}, {"puff", "soft", "facing"}, true},
    {"billboard", {{"alpha", "plain"}}, {"puff", "soft"}, true},
    {"billboard", {{"raster", "tiles"}}, {"alpha", "soft", "facing"}},
    {"billboard", {{"noise", "0.5"}}, {"puff", "soft", "alpha"}, true},
    {"grid_fluid", {{"solver", "opengl"}, {"backend", "gl"}}, {"advection", "limit", "velocity_at"}},
    {"grid_fluid", {{"solver", "opengl"}, {"backend", "gl"}}, {"pressure", "vorticity"}},
    {"grid_fluid", {{"solver", "opengl"}, {"backend", "gl"}}, {"fluid", "shadow_cells"}},
    {"grid_fluid", {{"backend", "cpu"}}, {"fluid"}},
    {"relief", {}, {"march", "shadow"}},
    {"relief", {}, {"state"}},
    {"octree_recursive", {}, {"render", "crossfade"}, true},
    {"grid_fluid", {{"scheme", "demo"}, {"fluid", "fire"}, {"solver", "opengl"}, {"backend", "gl"}}, {}},
    {"octree_search", {}, {"render", "crossfade"}, true},
    {"octree_search", {{"layout", "gpu"}}, {"render"}, true},
    {"voxel_shape", {}, {"render", "blend"}},
    {"exact_tiles", {}, {}, true},
    {"linked_list", {}, {"puff"}, true},
    {"multi_layer", {}, {"puff"}, true},
    {"adaptive_transparency", {}, {"puff"}, true},
    {"weighted_oit", {}, {"weight"}, true},
    {"weighted_oit", {{"raster", "tiles"}}, {"puff"}},
    {"weighted_oit", {}, {"puff", "accumulation", "revealage"}, true},
    {"offscreen_particles", {}, {"upsampling", "edges"}, true},
    {"stochastic_transparency", {}, {"puff", "stratified", "alpha_correction"}, true},
    {"moment_oit", {}, {"moments", "profile", "samples", "warp"}, true},
    {"wavelet_oit", {}, {"puff", "warp", "bounds"}, true},
    {"wavelet_oit", {}, {"rank"}, true},
    {"moment_oit", {}, {"moments", "basis", "precision", "puff"}, true},
};

std::vector<std::string> valuesOf(const Parameter& parameter) {
    if (const auto found = decidingValues.find(parameter.name); found != decidingValues.end()) return found->second;
    if (parameter.type == ParameterType::choice) return parameter.choices;
    if (parameter.type == ParameterType::boolean) return {"off", "on"};
    return {};
}

/// The complete input of a method at one moment.
class Stage {
 public:
    Stage(gpu::Device& device, const std::string& scene)
        : device_(device),
          world_(scene, "", ParameterValues(world::worldParameters()), 1),
          opaque_(world_.scene(), device, width, height) {
        world_.step();
        opaque_.draw(world_.state(), world_.view(width, height));
    }

    /// With and without its vehicle, its solids and light on its dust.
    void drawParts() {
        for (const bool vehicle : {false, true})
            for (const bool solids : {false, true})
                for (const bool lit : {false, true}) drawBare(vehicle, solids, lit);
    }

    void show(const MethodInfo& info, const Values& values, const particles::ParticleStore& dust) {
        if (info.cannotTake && !info.cannotTake(world_.scene()).empty())
            throw InputError(info.id + " cannot show the scene");
        ParameterValues given(info.parameters);
        for (const auto& [name, value] : small)
            if (info.parameters.find(name)) given.set(name, value);
        for (const auto& [name, value] : values) given.set(name, value);
        drawWith(info, given, world_.scene(), dust);
        if (!info.drawsPanels || !info.takesLights) return;
        // Panels under lit dust and curved ones have shaders of their own.
        for (const bool curved : {false, true})
            for (const bool lit : {false, true}) {
                if (curved && given.canonical().at("state") == "texture") continue;  // refused
                scene::Scene scene = world_.scene();
                scene.lights.onDust = lit;
                for (scene::Panel& panel : scene.panels) panel.curvaturePerMetre = {curved ? 0.1 : 0.0, 0};
                if (curved || lit) drawWith(info, given, scene, dust);
            }
    }

    /// Particles in front of the camera, each with its colour or all with one.
    void fill(particles::ParticleStore& dust, bool oneColour) const {
        const glm::dvec3 eye = world_.view(width, height).camera.eye, target = world_.view(width, height).camera.target;
        dust.resize(20);
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::vec3 at = glm::mix(eye, target, 0.5 + 0.05 * static_cast<double>(i));
            dust.serial[i] = i;
            dust.x[i] = at.x, dust.y[i] = at.y, dust.z[i] = at.z;
            dust.age[i] = 1, dust.lifetime[i] = 3;
            dust.radius[i] = 0.5f;
            dust.opacity[i] = 0.5f;
        }
        dust.keepOneColour(oneColour);
    }

 private:
    void drawWith(const MethodInfo& info, const ParameterValues& values, const scene::Scene& scene,
                  const particles::ParticleStore& dust) {
        const auto method = info.create(values);
        method->prepare(scene, {}, device_);
        gpu::Layer layer(device_, opaque_.depth());
        const scene::View view = world_.view(width, height);
        const StageClock untimed;
        for (int frame = 0; frame < frames; ++frame) {
            const Frame now{frame, world::stepSeconds, world_.state(), dust, view, untimed};
            method->update(now);
            layer.clear();
            method->draw(now, layer);
        }
        draw::Composite(device_, width, height).draw(opaque_.colour(), layer.colour());
    }

    /// The scene without its vehicle or its solids, which all our files contain.
    void drawBare(bool vehicle, bool solids, bool lit) {
        scene::Scene bare = world_.scene();
        if (!vehicle) bare.vehicle.reset();
        if (!solids) bare.solids.clear(), bare.solidPoses.clear();
        bare.lights.onDust = lit;
        draw::OpaqueScene opaque(bare, device_, width, height);
        opaque.draw(world_.state(), world_.view(width, height));
        const scene::PointLight lamp{{0, 2, 0}, glm::vec3(1)};
        opaque.draw(world_.state(), world_.view(width, height), {&lamp, 1});
    }

    gpu::Device& device_;
    world::World world_;
    draw::OpaqueScene opaque_;
};

/// Tries the scenes in order, because a fluid may need a solid that only one of them has.
class Stages {
 public:
    explicit Stages(gpu::Device& device) {
        // A plain with solids, hills, and reliefs that wear away: the shaders of all others are among these.
        for (const char* scene : {"carr_gates", "dunes", "relief_acid"}) Stage(device, scene).drawParts();
        for (const std::string& scene : files::listData("scenes", ".toml"))
            stages_.insert(scene == "plain" ? stages_.begin() : stages_.end(), std::make_unique<Stage>(device, scene));
        stages_.front()->fill(plain_, true);
        stages_.front()->fill(coloured_, false);
    }

    void show(const MethodInfo& info, const Values& values) { show(info, values, plain_); }
    /// True if each dust particle has its own colour.
    void showColours(const MethodInfo& info, const Values& values) { show(info, values, coloured_); }

 private:
    void show(const MethodInfo& info, const Values& values, const particles::ParticleStore& dust) {
        std::string reasons;
        for (const std::unique_ptr<Stage>& stage : stages_) try {
                return stage->show(info, values, dust);
            } catch (const InputError& error) {
                reasons += std::string(error.what()) + "\n";
            }
        throw std::runtime_error(info.id + " cannot be drawn in any scene:\n" + reasons);
    }

    std::vector<std::unique_ptr<Stage>> stages_;
    MemoryLedger ledger_;
    particles::ParticleStore plain_{ledger_}, coloured_{ledger_};
};

void forEachCombination(const MethodInfo& info, const Values& fixed, std::span<const std::string> parameters,
                        const std::function<void(const Values&)>& use) {
    if (parameters.empty()) return use(fixed);
    for (const std::string& value : valuesOf(*info.parameters.find(parameters.front()))) {
        Values values = fixed;
        values[parameters.front()] = value;
        forEachCombination(info, values, parameters.subspan(1), use);
    }
}

/// The grid that a method draws depends on its flow; a grid filled here is drawn with any settings.
void drawGrids(gpu::Device& device) {
    using namespace raycast;
    scene::View view;
    view.width = width;
    view.height = height;
    view.camera.eye = {0, 0, 9};
    view.camera.target = {0, 0, 0};
    gpu::Texture depth = gpu::Texture::make2D(device, "depth", gpu::Format::depth32F, width, height);
    depth.write(std::span<const float>(std::vector<float>(width * height, 0.0f)));
    gpu::Layer layer(device, depth);
    const std::vector<float> filled(8 * 8 * 8, 1.0f);
    const auto draw = [&](const RaycastSettings& settings, bool burning) {
        MemoryLedger ledger;
        GridRaycast grid(device, settings, scene::Lights(), ledger);
        grid.upload({{8, 8, 8},
                     0.5,
                     {-2, -2, -2},
                     filled,
                     burning ? std::span<const float>(filled) : std::span<const float>()});
        layer.clear();
        grid.draw(view, layer);
    };
    for (const bool burning : {false, true})
        for (const int shadowCells : {0, 2})
            for (const Filter filter : {Filter::nearest, Filter::linear, Filter::cubic}) {
                RaycastSettings settings;
                settings.shadowCells = shadowCells;
                settings.filter = filter;
                settings.backend = Backend::cpu;
                draw(settings, burning);
                settings.backend = Backend::gl;
                for (const Renderer renderer : {Renderer::slices, Renderer::splat, Renderer::isosurface}) {
                    settings.renderer = renderer;
                    draw(settings, burning);
                }
                settings.renderer = Renderer::raycast;
                for (const bool jitter : {false, true})
                    for (const bool skipEmpty : {false, true}) {
                        settings.jitter = jitter;
                        settings.skipEmpty = skipEmpty;
                        draw(settings, burning);
                    }
            }
}

/// Sparse smoke, with and without fire, so large that it contains every camera.
void drawSparse(Stages& stages) {
    const auto info = std::ranges::find(methods(), "volume", &MethodInfo::id);
    if (info == methods().end()) return;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("dustbench-sparse-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const auto field = [](const std::string& name) {
        return "<DataArray type=\"Float32\" Name=\"" + name + "\" format=\"ascii\">1 1 1 1 1 1 1 1</DataArray>";
    };
    std::ofstream(folder / "fire.vti")
        << "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 2 0 2 0 "
           "2\" "
           "Origin=\"-500 -500 -500\" Spacing=\"500 500 500\"><Piece Extent=\"0 2 0 2 0 2\"><CellData>"
        << field("density") << field("temperature") << "</CellData></Piece></ImageData></VTKFile>";
    std::ofstream(folder / "flame.toml") << "[[row]]\nreaction = 0.0\nemission = [0, 0, 0]\n[[row]]\nreaction = 1.0\n"
                                            "emission = [9, 3, 0]\n";
    std::ofstream(folder / "fire.toml")
        << "files = \"fire.vti\"\n[look]\nfire = \"flame.toml\"\ncold = 0.0\nhot = 1.0\n";
    const std::array<std::string, 3> parameters{"shadow_cells", "skip_empty", "jitter"};
    for (const char* file : {"fire.vti", "fire.toml"})
        forEachCombination(*info, {{"volume", (folder / file).string()}, {"storage", "sparse"}, {"backend", "gl"}},
                           parameters, [&](const Values& values) { stages.show(*info, values); });
    std::filesystem::remove_all(folder);
}

/// Experiments with their own shaders.
void runExperiments(gpu::Device& device) {
    class Context final : public ExperimentContext {
     public:
        explicit Context(gpu::Device& shared) : device_(shared) {}
        [[nodiscard]] std::uint64_t seed() const override { return 1; }
        [[nodiscard]] bool quick() const override { return true; }
        [[nodiscard]] gpu::Device& device() override { return device_; }
        [[nodiscard]] std::unique_ptr<ExperimentWorld> world(const std::string&,
                                                             const std::map<std::string, std::string>&, int,
                                                             int) override {
            throw std::logic_error("an experiment with shaders requested a world");
        }

     private:
        gpu::Device& device_;
    };
    Context context(device);
    for (const ExperimentInfo& info : experiments())
        if (info.id == "bandwidth") (void)info.run(context);
}

/// The sort in every way, and scan, compaction and reductions, with a number of elements from a buffer.
void sortNumbers(gpu::Device& device) {
    using namespace gpu;
    const std::vector<std::uint32_t> numbers{3, 1, 2};
    const Buffer given(device, "numbers", std::span<const std::uint32_t>(numbers));
    Buffer a(device, "a", 12), b(device, "b", 12), count(device, "count", std::span<const std::uint32_t>(numbers));
    DepthKeys(device, 3).write(given, count, DepthOrder::frontToBack, a, b);
    InclusiveScan(device, 3).scan(given, a, count);
    for (const Reduce operation : {Reduce::sum, Reduce::minimum, Reduce::maximum})
        for (const Number number : {Number::uint32, Number::float32})
            Reduction(device, 3, operation, number).reduce(given, count, a);
    for (const auto& earlier : earlierTilesChoices.all())
        for (const auto& ranks : warpRanksChoices.all()) try {
                RadixSort(device, 3, {earlier.value, ranks.value}).sort(a, b, count);
            } catch (const std::runtime_error&) {
                // Mesa refuses subgroups and does not look back. The reference compiler checks those programs.
                if (!device.isSoftware()) throw;
            }
    Compaction(device, 3).compact(given, given, 3u, a, count);
}

/// Dust in GPU buffers, of one colour and of two: its steps, and the methods that take it.
void drawGpuDust(gpu::Device& device) {
    const gpu::Texture depth = gpu::Texture::make2D(device, "depth", gpu::Format::depth32F, width, height);
    gpu::Layer layer(device, depth);
    const StageClock untimed;
    for (const char* scene : {"plain", "two_soils"}) {
        world::World world(scene, "", ParameterValues(world::worldParameters()), 1);
        world.moveDustTo(device);
        world.step();
        const scene::View view = world.view(width, height);
        const Frame now{0, world::stepSeconds, world.state(), Puffs{}, view, untimed, world.gpuDust()};
        for (const MethodInfo& info : methods()) {
            std::vector<std::string> choices;
            for (const char* name : {"soft", "puff", "warp"})
                if (info.parameters.find(name)) choices.emplace_back(name);
            forEachCombination(info, {}, choices, [&](const Values& given) {
                ParameterValues values(info.parameters);
                for (const auto& [name, value] : given) values.set(name, value);
                if (!info.takesGpuDust || !info.takesGpuDust(values)) return;
                const auto method = info.create(values);
                method->prepare(world.scene(), {}, device);
                method->update(now);
                method->draw(now, layer);
            });
        }
    }
}

void drawEverything(gpu::Device& device) {
    drawGpuDust(device);
    sortNumbers(device);
    (void)selfcheck::correctnessChecks(device);
    (void)selfcheck::measureRates(device, [] {});
    const view::SplitView twoPictures(device);
    drawGrids(device);
    runExperiments(device);
    Stages stages(device);
    for (const MethodInfo& info : methods()) {
        stages.show(info, {});
        stages.showColours(info, {});
        for (const Parameter& parameter : info.parameters.all())
            for (const std::string& value : valuesOf(parameter)) stages.show(info, {{parameter.name, value}});
    }
    drawSparse(stages);
    for (const Product& product : products) {
        const auto info = std::ranges::find(methods(), product.method, &MethodInfo::id);
        if (info == methods().end()) continue;
        forEachCombination(*info, product.fixed, product.parameters, [&](const Values& values) {
            stages.show(*info, values);
            if (product.showsDust) stages.showColours(*info, values);
        });
    }
}

}  // namespace

const std::set<CapturedProgram>& capturedPrograms() {
    static const std::set<CapturedProgram> all = [] {
        std::set<CapturedProgram> programs;
        gpu::listenToPrograms([&programs](std::string_view, std::span<const gpu::CompiledShader> shaders) {
            CapturedProgram program;
            for (const gpu::CompiledShader& shader : shaders)
                program.push_back({std::string(shader.file.name), shader.source});
            programs.insert(std::move(program));
        });
        gpu::Device device;
        drawEverything(device);
        gpu::listenToPrograms({});
        return programs;
    }();
    return all;
}

}  // namespace dustbench::shaders
