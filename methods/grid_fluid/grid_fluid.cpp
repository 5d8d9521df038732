#include "methods/grid_fluid/grid_fluid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "methods/grid_fluid/dust_mass.h"
#include "methods/grid_fluid/fluid_place.h"
#include "methods/shared/errors.h"
#include "methods/shared/maths/transmittance.h"
#include "methods/shared/scene/scene.h"
#include "methods/shared/volume.h"

namespace dustbench::grid_fluid {
namespace {

/// Beyond this the flow is no longer one: a step carries the air across most of a box.
constexpr float mostCellsPerStep = 100;
/// A vehicle this far from the box moves none of its cells.
constexpr double vehicleReachMetres = 8;

bool vehicleIsNear(const fluid::FluidBox& box, const scene::SceneState& state) {
    const glm::dvec3 place = state.vehicle.position;
    const glm::dvec3 nearest =
        glm::clamp(place, box.originMetres, box.originMetres + glm::dvec3(box.cells) * box.spacingMetres);
    return glm::distance(place, nearest) < vehicleReachMetres;
}

/// Whether the fluid is solved on the GPU, for a picture that is made where it says.
bool isSolvedOnGpu(SolverBackend wanted, raycast::Backend picture, const gpu::Device& device) {
    if (wanted != SolverBackend::automatic) return wanted == SolverBackend::openGl;
    return picture != raycast::Backend::cpu && !device.isSoftware();
}

}  // namespace

GridFluid::GridFluid(GridFluidSettings settings)
    : settings_(std::move(settings)),
      density_(ledger_.account("grid shown")),
      reaction_(ledger_.account("grid shown")) {}

void GridFluid::prepare(const scene::Scene& scene, gpu::Device& device) {
    scene_ = &scene;
    fluid::FluidSettings& solver = settings_.solver;
    solver.windMetresPerSecond = scene.wind;
    solver.sides = fluid::withWind(fluid::openOverFloor, scene.wind);
    if (!settings_.setup.followsVehicle)
        solver.box.originMetres = wantedOrigin(settings_.setup, solver.box, scene.terrain, {});
    solver_.emplace(solver, isSolvedOnGpu(settings_.solverBackend, settings_.picture.backend, device), device, ledger_);
    solids_.emplace(scene, solver.box.cells, ledger_.account("solids"));
    emitters_.emplace(settings_.setup.sources, scene, settings_.seed);
    if (!settings_.setup.followsVehicle) requireSourcesInside({});
    settings_.picture.smokeColour = settings_.setup.look.albedo.value_or(scene.dustAlbedo);
    picture_.emplace(device, settings_.picture, scene.lights, ledger_);
    const bool burns = !settings_.setup.look.fire.empty();
    if (solver_->onGpu() && picture_->takesTextures()) {
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
    const fluid::FluidBox& box = settings_.solver.box;
    const glm::dvec3 most = box.originMetres + glm::dvec3(box.cells) * box.spacingMetres;
    const auto sources = emitters_->at(state, 0, 1, 0);
    const bool any = std::ranges::any_of(sources, [&](const fluid::FluidSource& source) {
        const glm::dvec3 centre = source.centreMetres;
        return glm::all(glm::greaterThanEqual(centre, box.originMetres)) && glm::all(glm::lessThanEqual(centre, most));
    });
    if (!sources.empty() && !any)
        throw InputError(
            "fluid '" + settings_.setup.name + "': all of its sources lie outside the box, which goes from (" +
            std::to_string(box.originMetres.x) + ", " + std::to_string(box.originMetres.y) + ", " +
            std::to_string(box.originMetres.z) + ") to (" + std::to_string(most.x) + ", " + std::to_string(most.y) +
            ", " + std::to_string(most.z) + "); allowed: one source or more within it");
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
        if (settings_.setup.followsVehicle) {
            const glm::dvec3 wanted =
                wantedOrigin(settings_.setup, solver_->box(), scene_->terrain, frame.state.vehicle);
            if (const glm::ivec3 due = dueScroll(solver_->box(), wanted); due != glm::ivec3(0)) {
                solver_->scroll(due);
                solidsStandStill_ = false;
            }
        }
        placeSolids(frame.state);
    }
    const auto sources = emitters_->at(frame.state, steps_++, secondsDue_, dustDueM2_);
    const fluid::StepReport report = solver_->step(secondsDue_, sources, frame.clock);
    const auto cells = static_cast<double>(report.cellsPerStep);
    flow_.cellsPerStep = std::max(flow_.cellsPerStep, cells);
    flow_.speedMetresPerSecond =
        std::max(flow_.speedMetresPerSecond, cells * settings_.solver.box.spacingMetres / secondsDue_);
    flow_.divergencePerStep = std::max(flow_.divergencePerStep, static_cast<double>(report.divergencePerStep));
    if (report.cellsPerStep > mostCellsPerStep) {
        std::ostringstream text;
        text << "fluid: got a flow that goes " << report.cellsPerStep << " cells in step " << solver_->steps()
             << ", allowed: at most " << mostCellsPerStep << ": shorter steps, larger cells or weaker forces";
        throw InputError(text.str());
    }
    framesDue_ = 0;
    secondsDue_ = dustDueM2_ = 0;
}

void GridFluid::placeSolids(const scene::SceneState& state) {
    const bool moving = scene_->vehicle && vehicleIsNear(solver_->box(), state);
    if (solidsStandStill_ && !moving) return;
    solver_->setSolids(solids_->voxelise(solver_->box(), state));
    solidsStandStill_ = !moving;
}

void GridFluid::show() {
    const fluid::FluidBox& box = solver_->box();
    if (densityTexture_.bytes() > 0) {
        const bool burns = reactionTexture_.bytes() > 0;
        solver_->gather(fluid::density, densityTexture_);
        if (burns) solver_->gather(fluid::reaction, reactionTexture_);
        picture_->take(
            {box.cells, box.spacingMetres, box.originMetres, &densityTexture_, burns ? &reactionTexture_ : nullptr});
        return;
    }
    solver_->gather(fluid::density, density_);
    if (!reaction_.empty()) solver_->gather(fluid::reaction, reaction_);
    picture_->upload({box.cells, box.spacingMetres, box.originMetres, density_, reaction_});
}

void GridFluid::draw(const Frame& frame, gpu::Layer& layer) {
    picture_->draw(frame.view, layer);
}

void GridFluid::volume(const Frame&, VolumeVisitor& visitor) const {
    const fluid::FluidBox& box = solver_->box();
    const std::size_t count = box.cellCount();
    std::vector<float> density(count);
    solver_->gather(fluid::density, density);
    std::vector<float> extinction = density;
    for (float& value : extinction) value *= static_cast<float>(settings_.setup.look.extinctionPerMetre);
    std::array<std::vector<float>, 4> lanes;
    for (std::size_t n = 0; n < lanes.size(); ++n) {
        constexpr std::array from{fluid::velocityX, fluid::velocityY, fluid::velocityZ, fluid::temperature};
        lanes[n].resize(count);
        solver_->gather(from[n], lanes[n]);
    }
    const std::vector<float> pressure = solver_->pressuresM2PerS2();
    std::vector<float> velocity, reaction(count), solids;
    solver_->gather(fluid::reaction, reaction);
    for (std::size_t c = 0; c < count; ++c)
        for (std::size_t axis = 0; axis < 3; ++axis) velocity.push_back(lanes[axis][c]);
    for (const std::uint8_t body : solids_->bodies()) solids.push_back(body != 0 ? 1.0f : 0.0f);
    const std::array<GridField, 6> fields{{{"density", "1", 1, density},
                                           {"temperature", "K above the air", 1, lanes[3]},
                                           {"reaction", "1", 1, reaction},
                                           {"velocity", "m/s", 3, velocity},
                                           {"pressure", "m2/s2 (by density of the air)", 1, pressure},
                                           {"solids", "1 inside", 1, solids}}};
    visitor.grid({box.originMetres, box.spacingMetres, box.cells, extinction, fields});
}

double GridFluid::opticalMassSquareMetres() const {
    std::vector<float> density(solver_->box().cellCount());
    solver_->gather(fluid::density, density);
    double sum = 0;
    for (const float value : density) sum += static_cast<double>(value);
    return sum * settings_.setup.look.extinctionPerMetre * std::pow(settings_.solver.box.spacingMetres, 3);
}

std::optional<double> GridFluid::massKept(const Frame& frame) const {
    if (!settings_.setup.followsVehicle) return std::nullopt;
    double ofParticles = 0;
    for (std::size_t i = 0; i < frame.dust.size(); ++i)
        ofParticles += maths::puffMassSquareMetres(static_cast<double>(frame.dust.opacity[i]),
                                                   static_cast<double>(frame.dust.radius[i]));
    if (!(ofParticles > 0)) return std::nullopt;
    return opticalMassSquareMetres() / ofParticles;
}

MemoryReport GridFluid::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    if (solver_) std::ranges::move(solver_->gpuMemory(), std::back_inserter(report));
    if (const std::size_t bytes = densityTexture_.bytes() + reactionTexture_.bytes(); bytes > 0)
        report.push_back({"grid shown", 0, bytes});
    if (picture_) report.push_back({"picture", 0, picture_->gpuBytes()});
    return report;
}

std::int64_t GridFluid::primitives() const {
    return picture_ ? picture_->primitives() : 0;
}

std::optional<std::uint64_t> GridFluid::stateHash() const {
    return solver_ ? solver_->stateHash() : 0;
}

}  // namespace dustbench::grid_fluid
