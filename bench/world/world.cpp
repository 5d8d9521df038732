#include "bench/world/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "bench/world/control_source.h"
#include "bench/world/dust_series.h"
#include "bench/world/scene_file.h"
#include "bench/world/vehicle_dynamics.h"
#include "methods/contract/choices.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/light/lit_puffs.h"
#include "methods/kit/particles/part_list.h"
#include "methods/kit/particles/particle_system.h"
#include "methods/kit/particles_gl/gpu_system.h"
#include "methods/kit/particles_gl/step_values.h"

namespace dustbench::world {
namespace {

using scene::SceneState;
using scene::VehicleParameters;
using scene::VehicleState;

/// The light on the dust.
enum class DustLight {
    none,  ///< none: its own colours everywhere
    sun,   ///< sun and sky: scene::dustLight
};
constexpr Choices<DustLight> dustLights{{"none", DustLight::none}, {"sun", DustLight::sun}};

Drive readDrive(const std::filesystem::path& file, const std::string& id, const VehicleParameters& vehicle,
                double speed) {
    Drive drive = Drive::parseFile(file);
    if (speed > 0) {
        if (!drive.followsSpeed())
            throw InputError("parameter 'speed': the drive '" + id +
                             "' uses pedals and has no target speeds to replace");
        if (speed > vehicle.topSpeed)
            throw InputError("parameter 'speed': got " + files::csvNumber(speed) +
                             ", but the scene's vehicle has a top speed of " + files::csvNumber(vehicle.topSpeed));
        drive.replaceSpeeds(speed);
    }
    return drive;
}

/// Where the preroll must begin to end at `start`: reverses the path that it drives. Exact on level ground.
VehicleState placeBefore(const VehicleParameters& parameters, const scene::Terrain& terrain, const Start& start,
                         const ControlSource& controls, std::int64_t steps) {
    const std::unique_ptr<ControlSource> ahead = controls.clone();
    const VehicleState from = placeVehicle(parameters, terrain, start.x, start.z, start.heading, ahead->initialSpeed());
    VehicleState to = from;
    for (std::int64_t n = -steps; n < 0; ++n)
        to = step(parameters, to, ahead->decide(parameters, to, static_cast<double>(n) * stepSeconds), terrain,
                  stepSeconds);
    // The rigid motion from → to in the plane: the heading turns by `turn`, the displacement in the frame of `from` is
    // (forwards, right).
    const double turn = to.heading - from.heading;
    const glm::dvec2 moved(to.position.x - from.position.x, to.position.z - from.position.z);
    const double forwards = moved.x * std::cos(from.heading) - moved.y * std::sin(from.heading);
    const double right = moved.x * std::sin(from.heading) + moved.y * std::cos(from.heading);
    const double heading = start.heading - turn;
    const double x = start.x - (forwards * std::cos(heading) + right * std::sin(heading));
    const double z = start.z - (-forwards * std::sin(heading) + right * std::cos(heading));
    return placeVehicle(parameters, terrain, x, z, heading, controls.initialSpeed());
}

/// The dust of the file, emitted as the parameters of the world require.
particles::ParticleSystem emittedDust(const std::filesystem::path& file, const ParameterValues& parameters,
                                      std::uint64_t seed) {
    particles::ParticleSystem dust = particles::ParticleSystem::load(file, seed);
    const double perMetre = parameters.real("puffs_per_metre");
    if (perMetre <= 0) return dust;
    if (const std::int64_t fixedCount = parameters.integer("particles"); fixedCount > 0)
        throw InputError(
            fmt::format("parameter puffs_per_metre: got {} with particles={}, allowed: 0, because the number is fixed",
                        files::csvNumber(perMetre), fixedCount));
    changePart(dust.parts(), "emission.rate_per_second", "0");
    changePart(dust.parts(), "emission.rate_per_metre", files::csvNumber(perMetre));
    return dust;
}

std::size_t bytesOf(const scene::Mesh& mesh) {
    return mesh.positions.size() * 3 * sizeof(glm::vec3) + mesh.indices.size() * sizeof(std::uint32_t);
}

}  // namespace

const ParameterSet& worldParameters() {
    static const ParameterSet parameters = [] {
        ParameterSet set;
        set.integer("particles", 0, 0, 10'000'000, "",
                    "dust particles to keep alive on average; 0: according to the vehicle's speed");
        set.real("puffs_per_metre", 0, 0, 1000, "1/m",
                 "births of dust per metre driven, instead of the emission of the dust's file; 0: that of the file");
        set.real("speed", 0, 0, 60, "m/s", "replaces every target speed above 0 of the drive; 0: the drive's own");
        set.real("preroll", -1, -1, 120, "s", "untimed simulation before the drive begins; below 0: one mean lifetime");
        set.choice("camera", CameraKind::chase, cameraKinds, "which of the scene's cameras");
        set.choice(
            "light", DustLight::none, dustLights,
            "what lights the dust; none: one colour everywhere; sun: sun and sky, with shadows of the dust on itself");
        return set;
    }();
    return parameters;
}

/// Dust from a file, and its current particles.
struct ShownDust {
    ShownDust(DustSeries given, std::int64_t heldSteps, glm::vec3 colour)
        : series(std::move(given)), stepsHeld(heldSteps) {
        store.colourOfAll = colour;
        series.show(0, store);
    }

    void showAfter(std::int64_t steps) {
        series.show(static_cast<double>(std::max<std::int64_t>(steps - stepsHeld, 0)) * stepSeconds, store);
    }

    [[nodiscard]] MemoryReport memory() const {
        MemoryReport report;
        for (const auto& [structure, bytes] : ledger.entries()) report.push_back({structure, bytes, 0});
        report.push_back({"dust of the file", series.bytes(), 0});
        return report;
    }

    DustSeries series;
    std::int64_t stepsHeld;  ///< steps during which the first moment is shown
    MemoryLedger ledger;
    particles::ParticleStore store{ledger};
};

struct World::State {
    SceneFile file;
    std::string driveId;
    CameraKind camera;
    std::uint64_t seed;
    std::int64_t fixedCount;
    double perMetre;
    std::int64_t particlesPerPuff;
    bool raisesDust;
    particles::ParticleSystem dust;  ///< stays empty if the wheels raise no dust
    std::unique_ptr<ControlSource> source;
    std::int64_t prerollSteps = 0;
    std::int64_t stepIndex = 0;  ///< of the next step; 0 is the first step of the drive
    Controls controls{};
    SceneState now{};
    CameraLag lag{};
    std::optional<CameraPath> path{};                 ///< replaces `camera`
    std::unique_ptr<ShownDust> given{};               ///< replaces `dust`
    std::unique_ptr<particles::GpuSystem> gpuDust{};  ///< replaces `dust`, with its parts
    GpuPuffs gpuPuffs{};                              ///< of `gpuDust`
    light::LitPuffs litDust{};
    std::optional<Puffs> lit{};  ///< for this step and camera, once requested

    [[nodiscard]] const particles::ParticleStore& store() const {
        if (gpuDust) return gpuDust->readBack();
        return given ? given->store : dust.store();
    }
    [[nodiscard]] Puffs unlit() const { return store(); }
    [[nodiscard]] scene::Camera eyeCamera() const {
        return path ? path->at(now.timeSeconds) : cameraAt(camera, file.cameras, now, lag, file.scene.terrain);
    }

    [[nodiscard]] const VehicleParameters& vehicle() const { return file.scene.vehicle->parameters; }
    [[nodiscard]] double time() const { return static_cast<double>(stepIndex) * stepSeconds; }
    /// Updates everything that depends only on the time.
    void placeInTime() {
        now.timeSeconds = time();
        now.solids = file.movingSolids.at(file.scene, now.timeSeconds);
    }
};

World::World(const std::string& sceneId, const std::string& driveId, const ParameterValues& parameters,
             std::uint64_t seed, std::int64_t particlesPerPuff) {
    SceneFile file = readScene(files::findData("scene", "scenes", sceneId, ".toml"));
    const std::string drive = driveId.empty() ? file.drive : driveId;
    const auto driveFile = files::findData("drive", "drives", drive, ".csv");
    file.files.push_back(driveFile);
    auto source = std::make_unique<DriveControls>(
        readDrive(driveFile, drive, file.scene.vehicle->parameters, parameters.real("speed")));
    begin(std::move(file), drive, std::move(source), parameters, seed, particlesPerPuff);
}

World::World(const std::string& sceneId, std::unique_ptr<ControlSource> source, const ParameterValues& parameters,
             std::uint64_t seed) {
    begin(readScene(files::findData("scene", "scenes", sceneId, ".toml")), "", std::move(source), parameters, seed, 1);
}

void World::begin(SceneFile file, const std::string& drive, std::unique_ptr<ControlSource> source,
                  const ParameterValues& parameters, std::uint64_t seed, std::int64_t particlesPerPuff) {
    if (particlesPerPuff < 1) throw std::invalid_argument("World: at least 1 particle is born for each puff");
    const bool raisesDust = file.dust != noDust;
    const auto dustFile =
        files::findData("particle system", "particles", raisesDust ? file.dust : "wheel_dust", ".toml");
    if (raisesDust) file.files.push_back(dustFile);
    state_ = std::make_unique<State>(State{.file = std::move(file),
                                           .driveId = drive,
                                           .camera = parameters.choice("camera", cameraKinds),
                                           .seed = seed,
                                           .fixedCount = parameters.integer("particles"),
                                           .perMetre = parameters.real("puffs_per_metre"),
                                           .particlesPerPuff = particlesPerPuff,
                                           .raisesDust = raisesDust,
                                           .dust = emittedDust(dustFile, parameters, seed),
                                           .source = std::move(source)});
    State& s = *state_;
    s.file.scene.lights.onDust = parameters.choice("light", dustLights) == DustLight::sun;
    const double preroll = parameters.real("preroll");
    s.prerollSteps = std::llround((preroll < 0 ? s.dust.meanLifetimeSeconds() : preroll) / stepSeconds);
    s.stepIndex = -s.prerollSteps;
    s.now.vehicle = placeBefore(s.vehicle(), s.file.scene.terrain, s.file.start, *s.source, s.prerollSteps);
    s.placeInTime();
    s.lag = CameraLag::at(s.now.vehicle);
}

World::~World() = default;

const scene::Scene& World::scene() const {
    return state_->file.scene;
}
const SceneState& World::state() const {
    return state_->now;
}
Puffs World::dust() const {
    State& s = *state_;
    if (!s.file.scene.lights.onDust) return s.unlit();
    if (!s.lit) {
        const auto depths = light::sunDepths(s.unlit(), s.file.scene, 1.0 / static_cast<double>(s.particlesPerPuff));
        s.lit = s.litDust.light(s.unlit(), depths, s.file.scene, s.eyeCamera().eye);
    }
    return *s.lit;
}
Puffs World::unlitDust() const {
    return state_->unlit();
}
bool World::hasGivenDust() const {
    return state_->given != nullptr;
}
std::string World::whyDustStaysOnCpu() const {
    if (state_->given) return "dust from a file";
    if (state_->file.scene.lights.onDust) return "light=sun";
    return particles::partWithoutShader(state_->dust.parts());
}
void World::moveDustTo(gpu::Device& device) {
    State& s = *state_;
    if (const std::string why = whyDustStaysOnCpu(); !why.empty())
        throw InputError("dust_on: got gpu, but " + why + " has no shader, allowed: cpu");
    s.gpuDust = std::make_unique<particles::GpuSystem>(device, s.dust.parts(), s.seed);
    s.gpuPuffs = s.gpuDust->buffers();
}
const GpuPuffs* World::gpuDust() const {
    return state_->gpuDust ? &state_->gpuPuffs : nullptr;
}
RunSetup World::setup() const {
    return {state_->seed, state_->fixedCount};
}
std::int64_t World::prerollSteps() const {
    return state_->prerollSteps;
}
const Controls& World::controls() const {
    return state_->controls;
}
double World::driveSeconds() const {
    return state_->source->seconds();
}
bool World::isSceneDrawn() const {
    return state_->file.isDrawn;
}
const std::string& World::driveId() const {
    return state_->driveId;
}
std::vector<std::filesystem::path> World::inputFiles() const {
    return state_->file.files;
}

scene::View World::view(int width, int height) const {
    return {state_->eyeCamera(), width, height};
}

void World::look(CameraKind camera) {
    state_->camera = camera;
    state_->path.reset();
    state_->lit.reset();
}

void World::follow(CameraPath path) {
    state_->path = std::move(path);
    state_->lit.reset();
}

void World::followPath(const std::string& fileOrRows) {
    if (fileOrRows.empty()) return;
    follow(CameraPath::read(fileOrRows));
    if (isCameraFile(fileOrRows)) state_->file.files.emplace_back(fileOrRows);
}

void World::useDust(const GivenDust& given) {
    State& s = *state_;
    if (given.file.empty()) {
        if (!given.columns.empty()) throw InputError("--dust-columns: requires --dust");
        return;
    }
    if (s.stepIndex != -s.prerollSteps) throw std::logic_error("World::useDust: after the first step");
    if (s.fixedCount > 0)
        throw InputError(
            fmt::format("parameter particles: got {} with --dust {}, allowed: 0, because the file defines the "
                        "particles",
                        s.fixedCount, given.file));
    if (s.perMetre > 0)
        throw InputError(fmt::format(
            "parameter puffs_per_metre: got {} with --dust {}, allowed: 0, because the file defines the particles",
            files::csvNumber(s.perMetre), given.file));
    DustSeries series = DustSeries::read(given.file, given.columns);
    const double last = static_cast<double>(given.frames - 1) * stepSeconds;
    if (!series.isStill() && last > series.seconds() + sameMomentSeconds)
        throw InputError(fmt::format(
            "{}: ends {:.6g} s after its first moment, the run's last frame is at {:.6g} s, "
            "allowed: --frames 1..{:.0f}",
            given.file, series.seconds(), last, std::floor((series.seconds() + sameMomentSeconds) / stepSeconds) + 1));
    for (const std::filesystem::path& file : series.files()) s.file.files.push_back(file);
    if (series.albedo()) s.file.scene.dustAlbedo = *series.albedo();
    if (given.columns.ends_with(".toml")) s.file.files.emplace_back(given.columns);
    // Frame 0 is the step after preroll and warm-up; without a preroll, one step replaces it.
    const std::int64_t held = std::max<std::int64_t>(s.prerollSteps, 1) + given.warmup + 1;
    s.given = std::make_unique<ShownDust>(std::move(series), held, scene::dustColour(s.file.scene));
}

void World::readInput() {
    State& s = *state_;
    s.controls = s.source->decide(s.vehicle(), s.now.vehicle, s.time());
}

void World::simulate() {
    State& s = *state_;
    s.now.vehicle = world::step(s.vehicle(), s.now.vehicle, s.controls, s.file.scene.terrain, stepSeconds);
    ++s.stepIndex;
    s.placeInTime();
    s.lag = s.lag.followed(s.now.vehicle, s.file.cameras.chase.smoothingSeconds, stepSeconds);
    if (s.given)
        s.given->showAfter(s.stepIndex + s.prerollSteps);
    else if (s.raisesDust && s.gpuDust) {
        s.gpuDust->update({s.file.scene, s.now, stepSeconds, s.fixedCount});
        s.gpuPuffs = s.gpuDust->buffers();
    } else if (s.raisesDust)
        s.dust.update({s.file.scene, s.now, stepSeconds, s.fixedCount, s.particlesPerPuff});
    s.lit.reset();
}

std::uint64_t World::stateHash() const {
    const std::uint64_t dust = state_->store().hash();
    return particles::stateHash(state_->now, std::span(&dust, 1));
}

MemoryReport World::memory() const {
    const scene::Scene& scene = state_->file.scene;
    std::size_t meshBytes = bytesOf(*scene.vehicle->body.mesh) + bytesOf(*scene.vehicle->wheel.mesh);
    for (const scene::Solid& solid : scene.solids) meshBytes += bytesOf(*solid.mesh);
    for (const scene::SolidNow& solid : state_->now.solids)
        if (solid.shape) meshBytes += bytesOf(solid.shape->mesh) + solid.shape->velocities.size() * sizeof(glm::vec3);
    meshBytes += state_->file.movingSolids.bytes();
    MemoryReport report = state_->gpuDust ? state_->gpuDust->memory()
                          : state_->given ? state_->given->memory()
                                          : state_->dust.memory();
    if (scene.lights.onDust) report.push_back({"light of the dust", state_->litDust.bytes(), 0});
    report.push_back({"terrain", scene.terrain.heights().size() * sizeof(float), 0});
    report.push_back({"meshes", meshBytes, 0});
    return report;
}

}  // namespace dustbench::world
