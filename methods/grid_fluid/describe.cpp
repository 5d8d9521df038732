// Declares the method, and applies its parameters to the setup from a fluid's file.
#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/grid_fluid/grid_fluid.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/raycast/raycast_settings.h"

namespace dustbench::grid_fluid {
namespace {

constexpr double asTheFileSays = -1;

constexpr Choices<flow::AdvectionScheme> advectionSchemes{{"semi_lagrangian", flow::AdvectionScheme::semiLagrangian},
                                                          {"maccormack", flow::AdvectionScheme::macCormack}};
constexpr Choices<flow::Limit> limits{
    {"clamp", flow::Limit::clamp}, {"revert", flow::Limit::revert}, {"none", flow::Limit::none}};
constexpr Choices<flow::VelocityAt> velocityTimes{{"begin", flow::VelocityAt::begin},
                                                  {"middle", flow::VelocityAt::middle}};
constexpr Choices<flow::PressureMethod> pressureMethods{{"jacobi", flow::PressureMethod::jacobi},
                                                        {"multigrid", flow::PressureMethod::multigrid}};
constexpr Choices<FlowScheme> schemes{{"ours", FlowScheme::ours}, {"demo", FlowScheme::demo}};
constexpr Choices<SolverBackend> solverBackends{
    {"auto", SolverBackend::automatic}, {"cpu", SolverBackend::cpu}, {"opengl", SolverBackend::openGl}};

std::vector<std::string> fluidNames() {
    std::vector<std::string> names = files::listData("fluids", ".toml");
    if (std::ranges::find(names, "dust") == names.end()) names.emplace_back("dust");
    return names;
}

/// The choice that leaves a setting to the fluid's file.
constexpr const char* ofTheFluid = "preset";

std::vector<std::string> flameNames() {
    std::vector<std::string> names = files::listData("fluids/flame", ".toml");
    names.insert(names.begin(), ofTheFluid);
    return names;
}

void override(const ParameterValues& values, const char* name, float& value) {
    if (const double given = values.real(name); given >= 0) value = static_cast<float>(given);
    // Values between "as in the file" and 0 have no meaning.
    else if (given != asTheFileSays)
        throw InputError(std::string("parameter ") + name + ": got " + std::to_string(given) +
                         ", allowed: 0 or more, or -1 for the value of the fluid's file");
}

double spacingOf(const ParameterValues& values, const FluidSetup& setup, int cellsAlongX) {
    const double given = values.real("spacing_m");
    if (given == asTheFileSays) return setup.lengthMetres / cellsAlongX;
    if (given > 0) return given;
    throw InputError("parameter spacing_m: got " + std::to_string(given) +
                     " m, allowed: more than 0, or -1 for the length of the fluid's box divided by its cells along x");
}

GridFluidSettings settingsOf(const ParameterValues& values) {
    GridFluidSettings settings;
    settings.setup = readFluid(files::findData("fluid", "fluids", values.choice("fluid"), ".toml"));
    FluidSetup& setup = settings.setup;
    override(values, "vorticity", setup.forces.confinementPerSecond);
    override(values, "buoyancy", setup.forces.buoyancyPerKelvin);
    override(values, "cooling", setup.forces.coolingPerSecond);
    override(values, "decay", setup.forces.densityDecayPerSecond);
    override(values, "diffusion", setup.forces.viscosityM2PerSecond);

    flow::FluidSettings& solver = settings.solver;
    const auto cells = values.cells("grid");
    solver.box.cells = {cells[0], cells[1], cells[2]};
    solver.box.spacingMetres = spacingOf(values, setup, cells[0]);
    solver.forces = setup.forces;
    solver.noSlip = setup.noSlip;
    solver.advection.scheme = values.choice("advection", advectionSchemes);
    solver.advection.limit = values.choice("limit", limits);
    solver.advection.velocityAt = values.choice("velocity_at", velocityTimes);
    solver.keepsDensity = setup.keepsDensity;
    solver.pressure = values.choice("pressure", pressureMethods);
    solver.jacobiSweeps = static_cast<int>(values.integer("sweeps"));
    solver.divergencePerStep = static_cast<float>(values.real("tolerance"));
    flow::check(solver.box);
    settings.scheme = values.choice("scheme", schemes);
    const bool atWheels =
        std::ranges::any_of(setup.sources, [](const SourceSetup& s) { return s.at == SourceAt::wheels; });
    if (settings.scheme == FlowScheme::demo && (setup.followsVehicle || atWheels))
        throw InputError("parameter scheme: got demo with fluid '" + setup.name +
                         "', which follows the vehicle, allowed: ours, since the demo's box cannot move");
    settings.solverBackend = values.choice("solver", solverBackends);
    settings.proxyCells = values.real("proxy_cells");
    settings.trail = values.boolean("trail");
    settings.framesPerStep = static_cast<int>(values.integer("frames_per_step"));

    raycast::RaycastSettings& picture = settings.picture;
    picture = raycast::raycastSettings(values, setup.look.shadowCells);
    picture.extinctionPerMetre = setup.look.extinctionPerMetre;
    std::filesystem::path fire = setup.look.fire;
    if (const std::string& flame = values.choice("flame"); flame != ofTheFluid)
        fire = files::findData("flame", "fluids/flame", flame, ".toml");
    if (!fire.empty()) picture.fire = raycast::loadTransferFunction(fire);
    return settings;
}

}  // namespace

MethodInfo describe() {
    MethodInfo info;
    info.title = "Grid fluid";
    info.summary = "Simulates smoke, fire or dust on a grid, with solids as obstacles, and ray casts it.";
    info.source = "Senger2009";
    info.takesLights = true;
    info.parameters.dataFile("fluid", "dust", "fluids", ".toml", fluidNames(), "fluid, with its sources and its box")
        .cells("grid", "128x64x64", 4, 4096, "cells along x, y and z")
        .real("spacing_m", asTheFileSays, asTheFileSays, 1000, "m",
              "edge of a cell; -1: the length of the fluid's box divided by its cells along x")
        .choice("scheme", FlowScheme::ours, schemes,
                "ours: set by the parameters below; demo: the demo as published, with half floats at the cells' "
                "centres, forward MacCormack clamped to eight nodes, six sweeps, its own confinement and decay")
        .choice("advection", flow::AdvectionScheme::macCormack, advectionSchemes,
                "trace back along the flow, without or with MacCormack's correction of the error")
        .choice("limit", flow::Limit::revert, limits,
                "if MacCormack's correction overshoots: clamp to the cells around, as in the paper; revert to the "
                "uncorrected value; or leave it")
        .choice("velocity_at", flow::VelocityAt::begin, velocityTimes,
                "velocity that paths follow: at the beginning of the step, or at its middle, extrapolated from the "
                "last two states, which makes paths second-order accurate in time")
        .choice("pressure", flow::PressureMethod::multigrid, pressureMethods,
                "a fixed number of Jacobi sweeps, as in the paper, or multigrid cycles until the tolerance is met")
        .choice("solver", SolverBackend::automatic, solverBackends,
                "processor that computes the flow; auto: the GPU if OpenGL has one and casts the rays there, else CPU")
        .integer("sweeps", 40, 0, 100'000, "", "number of Jacobi sweeps with pressure=jacobi")
        .real("tolerance", 0.001, 1e-7, 10, "",
              "share of its volume that a cell may gain in a step with pressure=multigrid")
        .real("vorticity", asTheFileSays, asTheFileSays, 1000, "1/s", "vorticity confinement; -1: as in the file")
        .real("buoyancy", asTheFileSays, asTheFileSays, 1e6, "m/s2/K", "acceleration per kelvin; -1: as in the file")
        .real("cooling", asTheFileSays, asTheFileSays, 1000, "1/s", "rate of heat loss; -1: as in the file")
        .real("decay", asTheFileSays, asTheFileSays, 1000, "1/s", "rate of density loss; -1: as in the file")
        .real("diffusion", asTheFileSays, asTheFileSays, 1000, "m2/s", "viscosity; -1: as in the file")
        .real(
            "proxy_cells", 0, 0, 16, "cells",
            "edge of the cubes in which the vertices of solids and of the car are merged before they are voxelised; 0: "
            "none are")
        .choice("flame", ofTheFluid, flameNames(),
                "colour and brightness of fire by its freshness: a table of rows, or a black body by Planck's law; "
                "preset: as in the fluid's file")
        .boolean(
            "trail", true,
            "keep the dust that leaves a box that follows the vehicle: the wind carries it, and it fades with age; "
            "renderer=isosurface shows the box only")
        .integer("frames_per_step", 1, 1, 600, "frames", "number of frames for each step of the fluid");
    raycast::declareRaycast(info.parameters);
    info.facts = {
        {"mass_kept", "share", FactOver::lastFrame,
         "share of the particles' optical mass that the method's volume holds after the last frame; dust outside of "
         "the volume's box is missing from it"},
        {"mass_lost",
         "share",
         FactOver::lastFrame,
         "share of the optical mass that the method's rule keeps and its volume does not hold, after the last frame",
         {.maximum = 0.01}},
        {"flow_speed_max", "m/s", FactOver::lastFrame, "speed of the flow along an axis: maximum since the beginning"},
        {"flow_cells_per_step_max", "cells", FactOver::lastFrame,
         "distance that the flow covers in a step (the Courant number): maximum since the beginning"},
        {"flow_divergence_max", "share", FactOver::lastFrame,
         "share of its volume that a cell gains in a step after the pressure solve: maximum since the beginning"},
        {"flow_divergence", "share", FactOver::lastFrame,
         "share of its volume that a cell gains in a step by the stored speeds of its faces: maximum after the last "
         "frame"},
        {"flow_noise_speed", "share", FactOver::lastFrame,
         "share of the variance of the stored vertical speed in the top fifth of the spectrum along the vertical "
         "(waves shorter than 2.5 cells), in columns clear of solids, after the last frame"},
        {"flow_noise_density", "share", FactOver::lastFrame,
         "share of the variance of the density in the top fifth of the spectrum along the vertical, as in "
         "`flow_noise_speed`, after the last frame"},
        {"pressure_unsolved",
         "steps",
         FactOver::lastFrame,
         "steps in which the pressure solver ran out of cycles before it met its tolerance: number since the "
         "beginning; empty for a fixed number of sweeps",
         {0, 0}}};
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<GridFluid>(settingsOf(values));
    };
    return info;
}

}  // namespace dustbench::grid_fluid
