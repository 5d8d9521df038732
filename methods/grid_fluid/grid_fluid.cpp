#include "methods/grid_fluid/grid_fluid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "methods/contract/errors.h"
#include "methods/contract/scene.h"
#include "methods/contract/volume.h"
#include "methods/grid_fluid/emitters.h"
#include "methods/grid_fluid/flow/grid_noise.h"
#include "methods/grid_fluid/fluid_setup.h"
#include "methods/kit/maths/hash.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/raycast/raycast_settings.h"

namespace dustbench::grid_fluid {
namespace {

/// Above this the result is meaningless: a step carries the air across most of a box.
constexpr float maximumCellsPerStep = 100;
/// A vehicle at this distance from the box does not affect any cell.
constexpr double vehicleReachMetres = 8;

bool vehicleIsNear(const flow::FluidBox& box, const scene::SceneState& state) {
    const glm::dvec3 place = state.vehicle.position;
    const glm::dvec3 nearest =
        glm::clamp(place, box.originMetres, box.originMetres + glm::dvec3(box.cells) * box.spacingMetres);
    return glm::distance(place, nearest) < vehicleReachMetres;
}

/// Whether the fluid is solved on the GPU, given the backend that draws the picture.
bool isSolvedOnGpu(SolverBackend wanted, raycast::Backend picture, const gpu::Device& device) {
    if (wanted != SolverBackend::automatic) return wanted == SolverBackend::openGl;
    return picture != raycast::Backend::cpu && !device.isSoftware();
}

}  // namespace

GridFluid::GridFluid(GridFluidSettings settings)
    : settings_(std::move(settings)),
      density_(ledger_.account("grid shown")),
      reaction_(ledger_.account("grid shown")) {}

void GridFluid::prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) {
    scene_ = &scene;
    flow::FluidSettings& solver = settings_.solver;
    solver.windMetresPerSecond = scene.wind;
    solver.sides = flow::withWind(flow::openOverFloor, scene.wind);
    if (!settings_.setup.followsVehicle)
        solver.box.originMetres = wantedOrigin(settings_.setup, solver.box, scene.terrain, {});
    const bool onGpu = isSolvedOnGpu(settings_.solverBackend, settings_.picture.backend, device);
    const bool burns = !settings_.setup.look.fire.empty();
    if (settings_.scheme == FlowScheme::demo && scene.wind != glm::vec3(0))
        throw InputError("parameter scheme: got demo in scene '" + scene.id +
                         "', which has wind, allowed: ours, since the demo has no wind");
    if (settings_.setup.followsVehicle && settings_.trail) {
        solver.notesLeaving = true;
        trail_.emplace(solver, settings_.setup.look.extinctionPerMetre, ledger_);
    }
    solver_ = makeFlowSolver(solver, settings_.scheme, burns, onGpu, device, ledger_);
    if (onGpu) rays_.emplace(device, solver.box.cells);
    solids_.emplace(scene, solver.box.cells, ledger_.account("solids"), rays_ ? &*rays_ : nullptr,
                    settings_.proxyCells);
    emitters_.emplace(settings_.setup.sources, scene, setup.seed);
    if (!settings_.setup.followsVehicle) requireSourcesInside({});
    if (scene.lights.onDust) raycast::lightDust(settings_.picture, scene);
    settings_.picture.smokeColour = settings_.setup.look.albedo.value_or(scene.dustAlbedo);
    picture_.emplace(device, settings_.picture, scene.lights, ledger_);
    // Where box and trail share the density, neither reaches that of the isosurface.
    if (trail_ && settings_.picture.renderer != raycast::Renderer::isosurface)
        trailPicture_.emplace(*picture_, settings_.picture, scene.lights.toSun, scene.terrain.isFlat());
    // Box and trail are blended on the host.
    if (solver_->onGpu() && picture_->takesTextures() && !trail_) {
        const glm::ivec3 cells = solver.box.cells;
        const auto make = [&](gpu::Texture& texture) {
            texture = gpu::Texture::make3D(device, "grid shown", gpu::Format::r32F, cells.x, cells.y, cells.z);
        };
        make(densityTexture_);
        if (burns) make(reactionTexture_);
    } else {
        density_.resize(solver.box.cellCount());
        if (burns) reaction_.resize(solver.box.cellCount());
    }
}

void GridFluid::requireSourcesInside(const scene::SceneState& state) {
    const flow::FluidBox& box = settings_.solver.box;
    const glm::dvec3 maximum = box.originMetres + glm::dvec3(box.cells) * box.spacingMetres;
    const auto sources = emitters_->at(state, 0, 1, 0);
    const bool any = std::ranges::any_of(sources, [&](const flow::FluidSource& source) {
        const glm::dvec3 centre = source.centreMetres;
        return glm::all(glm::greaterThanEqual(centre, box.originMetres)) &&
               glm::all(glm::lessThanEqual(centre, maximum));
    });
    if (!sources.empty() && !any)
        throw InputError(
            "fluid '" + settings_.setup.name + "': all of its sources lie outside the box, which extends from (" +
            std::to_string(box.originMetres.x) + ", " + std::to_string(box.originMetres.y) + ", " +
            std::to_string(box.originMetres.z) + ") to (" + std::to_string(maximum.x) + ", " +
            std::to_string(maximum.y) + ", " + std::to_string(maximum.z) + "); expected at least one source in it");
}

void GridFluid::update(const Frame& frame) {
    {
        const auto timing = frame.clock.measure(Stage::simulate);
        ++framesDue_;
        secondsDue_ += frame.stepSeconds;
        dustDueM2_ +=
            static_cast<double>(bornWithin(frame.dust, frame.stepSeconds)) * meanPuffMassSquareMetres(frame.dust);
        if (framesDue_ >= settings_.framesPerStep) simulate(frame);
    }
    const auto timing = frame.clock.measure(Stage::upload);
    show();
}

void GridFluid::simulate(const Frame& frame) {
    {
        const auto timing = frame.clock.measureDetail("solids");
        if (settings_.setup.followsVehicle) follow(frame.state.vehicle);
        placeSolids(frame.state);
    }
    const auto sources = emitters_->at(frame.state, steps_++, secondsDue_, dustDueM2_);
    const flow::StepReport report = solver_->step(secondsDue_, sources, frame.clock);
    if (trail_) {
        const auto timing = frame.clock.measureDetail("trail");
        trail_->pass(*solver_, static_cast<float>(secondsDue_), sources);
    }
    const auto cells = static_cast<double>(report.cellsPerStep);
    extremes_.cellsPerStep = std::max(extremes_.cellsPerStep, cells);
    extremes_.speedMetresPerSecond =
        std::max(extremes_.speedMetresPerSecond, cells * settings_.solver.box.spacingMetres / secondsDue_);
    extremes_.divergencePerStep = std::max(extremes_.divergencePerStep, static_cast<double>(report.divergencePerStep));
    const bool isSolved = report.divergencePerStep <= 1.001f * settings_.solver.divergencePerStep;  // rounded
    if (solvesPressure() && !isSolved) ++extremes_.unsolvedSteps;
    if (report.cellsPerStep > maximumCellsPerStep) {
        std::ostringstream text;
        text << "fluid: the flow moves " << report.cellsPerStep << " cells in step " << solver_->steps()
             << ", allowed: at most " << maximumCellsPerStep << "; use shorter steps, larger cells or weaker forces";
        throw InputError(text.str());
    }
    framesDue_ = 0;
    secondsDue_ = dustDueM2_ = 0;
}

void GridFluid::follow(const scene::VehicleState& vehicle) {
    const flow::FluidBox& box = solver_->box();
    const glm::ivec3 due = dueScroll(box, wantedOrigin(settings_.setup, box, scene_->terrain, vehicle));
    if (due != glm::ivec3(0)) {
        if (trail_) {
            // Read back only now: a box on the GPU moves once in several steps.
            std::vector<float> density(box.cellCount());
            gatherSeen(flow::density, density);
            trail_->leave(box, due, density);
        }
        solver_->scroll(due);
        solidsStandStill_ = false;
    }
    if (trail_) trail_->enter(*solver_);
}

void GridFluid::placeSolids(const scene::SceneState& state) {
    const bool moving = scene::anySolidMoves(*scene_) || (scene_->vehicle && vehicleIsNear(solver_->box(), state));
    if (solidsStandStill_ && !moving) return;
    solver_->setSolids(solids_->voxelise(solver_->box(), state));
    solidsStandStill_ = !moving;
}

void GridFluid::gatherSeen(flow::Lane lane, std::span<float> to) const {
    solver_->gather(lane, to);
    if (settings_.solver.advection.limit == flow::Limit::none)
        for (float& value : to) value = std::max(value, 0.0f);
}

void GridFluid::show() {
    const flow::FluidBox& box = solver_->box();
    if (densityTexture_.bytes() > 0) {
        const bool burns = reactionTexture_.bytes() > 0;
        solver_->gather(flow::density, densityTexture_);
        if (burns) solver_->gather(flow::reaction, reactionTexture_);
        picture_->take(
            {box.cells, box.spacingMetres, box.originMetres, &densityTexture_, burns ? &reactionTexture_ : nullptr});
        return;
    }
    gatherSeen(flow::density, density_);
    if (!reaction_.empty()) gatherSeen(flow::reaction, reaction_);
    const raycast::ShownGrid shown{box.cells, box.spacingMetres, box.originMetres, density_, reaction_};
    if (trailPicture_)
        trailPicture_->show(trail_->dust(), shown);
    else
        picture_->upload(shown);
}

void GridFluid::draw(const Frame& frame, gpu::Layer& layer) {
    if (trailPicture_)
        trailPicture_->draw(frame.view, layer);
    else
        picture_->draw(frame.view, layer);
}

void GridFluid::volume(const Frame&, VolumeVisitor& visitor) const {
    const flow::FluidBox& box = solver_->box();
    const std::size_t count = box.cellCount();
    std::vector<float> density(count);
    solver_->gather(flow::density, density);
    std::vector<float> extinction(count);
    gatherSeen(flow::density, extinction);
    for (float& value : extinction) value *= static_cast<float>(settings_.setup.look.extinctionPerMetre);
    std::array<std::vector<float>, 4> lanes;
    for (std::size_t n = 0; n < lanes.size(); ++n) {
        constexpr std::array from{flow::velocityX, flow::velocityY, flow::velocityZ, flow::temperature};
        lanes[n].resize(count);
        solver_->gather(from[n], lanes[n]);
    }
    const std::vector<float> pressure = solver_->pressuresM2PerS2();
    std::vector<float> velocity, faces, reaction(count), solids;
    solver_->gather(flow::reaction, reaction);
    for (std::size_t c = 0; c < count; ++c)
        for (std::size_t axis = 0; axis < 3; ++axis) velocity.push_back(lanes[axis][c]);
    for (std::size_t axis = 0; axis < 3; ++axis)
        solver_->gatherStored(std::array{flow::velocityX, flow::velocityY, flow::velocityZ}[axis], lanes[axis]);
    for (std::size_t c = 0; c < count; ++c)
        for (std::size_t axis = 0; axis < 3; ++axis) faces.push_back(lanes[axis][c]);
    for (const std::uint8_t body : solids_->bodies()) solids.push_back(body != 0 ? 1.0f : 0.0f);
    const std::array<GridField, 7> fields{{{"density", "1", 1, density},
                                           {"temperature", "K above the air", 1, lanes[3]},
                                           {"reaction", "1", 1, reaction},
                                           {"velocity", "m/s", 3, velocity},
                                           {"face_speeds", "m/s (across the faces towards -x, -y, -z)", 3, faces},
                                           {"pressure", "m2/s2 (divided by the density of air)", 1, pressure},
                                           {"solids", "1 inside", 1, solids}}};
    visitor.grid({box.originMetres, box.spacingMetres, box.cells, extinction, fields});
    if (trail_) volumeOfTrail(visitor);
}

/// The trail's tiles as separate grids, without fields.
void GridFluid::volumeOfTrail(VolumeVisitor& visitor) const {
    std::vector<float> extinction(DustTrail::tileCells);
    for (const auto& [place, tile] : trail_->dust().tiles()) {
        const auto scale = static_cast<float>(tile.share * settings_.setup.look.extinctionPerMetre);
        std::ranges::transform(tile.density, extinction.begin(), [&](float value) { return value * scale; });
        visitor.grid({trail_->dust().originOf(place),
                      trail_->dust().spacingMetres(),
                      glm::ivec3(DustTrail::edge),
                      extinction,
                      {}});
    }
}

double GridFluid::amountM3() const {
    std::vector<float> density(solver_->box().cellCount());
    solver_->gather(flow::density, density);
    double sum = 0;
    for (const float value : density) sum += static_cast<double>(value);
    return sum * std::pow(settings_.solver.box.spacingMetres, 3) + (trail_ ? trail_->dust().amountM3() : 0);
}

double GridFluid::opticalMassSquareMetres() const {
    return amountM3() * settings_.setup.look.extinctionPerMetre;
}

std::optional<double> GridFluid::massLost() const {
    const bool isKnown = std::ranges::all_of(settings_.setup.sources, [](const SourceSetup& source) {
        return source.at == SourceAt::wheels || source.densityPerSecond == 0;
    });
    if (!trail_ || !settings_.solver.keepsDensity || !isKnown) return std::nullopt;
    const std::optional<double> due = trail_->dueM3();
    if (!due) return std::nullopt;
    return std::abs(1 - amountM3() / *due);
}

void GridFluid::report(const Frame& frame, Facts& facts) const {
    facts.set("flow_speed_max", extremes_.speedMetresPerSecond);
    facts.set("flow_cells_per_step_max", extremes_.cellsPerStep);
    facts.set("flow_divergence_max", extremes_.divergencePerStep);
    if (solvesPressure()) facts.set("pressure_unsolved", extremes_.unsolvedSteps);
    if (facts.wants("flow_divergence")) facts.set("flow_divergence", static_cast<double>(solver_->divergencePerStep()));
    if (facts.wants("flow_noise_speed")) facts.set("flow_noise_speed", noiseOf(flow::velocityY));
    if (facts.wants("flow_noise_density")) facts.set("flow_noise_density", noiseOf(flow::density));
    if (facts.wants("mass_lost"))
        if (const auto lost = massLost()) facts.set("mass_lost", *lost);
    if (!facts.wants("mass_kept")) return;
    if (const auto kept = massKept(frame.dust)) facts.set("mass_kept", *kept);
}

double GridFluid::noiseOf(flow::Lane lane) const {
    std::vector<float> values(solver_->box().cellCount());
    solver_->gatherStored(lane, values);
    return flow::gridNoise(values, solids_->bodies(), solver_->box().cells);
}

std::optional<double> GridFluid::massKept(const Puffs& dust) const {
    if (!settings_.setup.followsVehicle) return std::nullopt;
    double ofParticles = 0;
    for (std::size_t i = 0; i < dust.size(); ++i)
        ofParticles +=
            maths::puffMassSquareMetres(static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]));
    if (!(ofParticles > 0)) return std::nullopt;
    return opticalMassSquareMetres() / ofParticles;
}

MemoryReport GridFluid::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    if (solver_) std::ranges::move(solver_->gpuMemory(), std::back_inserter(report));
    if (const std::size_t bytes = densityTexture_.bytes() + reactionTexture_.bytes(); bytes > 0)
        report.push_back({"grid shown", 0, bytes});
    if (rays_) report.push_back({"fluid voxelisation", 0, rays_->bytes()});
    if (picture_) report.push_back({"picture", 0, picture_->gpuBytes()});
    if (trailPicture_) report.push_back({"picture of the trail", 0, trailPicture_->gpuBytes()});
    return report;
}

std::int64_t GridFluid::primitives() const {
    if (trailPicture_) return trailPicture_->primitives();
    return picture_ ? picture_->primitives() : 0;
}

std::optional<std::uint64_t> GridFluid::stateHash() const {
    if (!solver_) return 0;
    if (!trail_) return solver_->stateHash();
    return maths::Hash().add(solver_->stateHash()).add(trail_->dust().stateHash()).value();
}

}  // namespace dustbench::grid_fluid
