#include "methods/grid_fluid/demo/gl_demo_solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "grid_fluid_demo_shaders.h"
#include "methods/contract/errors.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/kit/maths/hash.h"

namespace dustbench::grid_fluid::demo {
namespace {

using namespace grid_fluid_demo_shaders;
using flow_gl::Kernel;

gpu::Texture fieldOf(gpu::Device& device, gpu::Format format, const glm::ivec3& cells) {
    gpu::Texture texture =
        gpu::Texture::make3D(device, "demo field", format, cells.x, cells.y, cells.z, gpu::Filter::nearest);
    const auto count =
        static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(cells.z);
    if (format == gpu::Format::r8)
        texture.write(std::vector<std::uint8_t>(count));
    else
        texture.write(std::vector<float>(count * (format == gpu::Format::r16F ? 1 : 4)));
    return texture;
}

std::map<std::string, std::string> definitionsOf(const DemoSettings& settings) {
    return {{"SIDES", flow_gl::sidesText(settings.sides)}};
}

Kernel kernelOf(gpu::Device& device, const DemoSettings& settings, const gpu::ShaderFile& file,
                const std::map<std::string, std::string>& more = {}) {
    std::map<std::string, std::string> definitions = more;
    definitions.merge(definitionsOf(settings));
    Kernel kernel(device, {demo_glsl, file}, definitions);
    if (file.name != demo_source_comp.name) kernel.set("cells", settings.box.cells);
    return kernel;
}

float valueOf(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}

}  // namespace

GlDemoSolver::GlDemoSolver(const DemoSettings& settings, gpu::Device& device)
    : settings_(checked(settings)),
      velocity_(fieldOf(device, gpu::Format::rgba16F, settings.box.cells)),
      otherVelocity_(fieldOf(device, gpu::Format::rgba16F, settings.box.cells)),
      vector_(fieldOf(device, gpu::Format::rgba16F, settings.box.cells)),
      density_(fieldOf(device, gpu::Format::r16F, settings.box.cells)),
      temperature_(fieldOf(device, gpu::Format::r16F, settings.box.cells)),
      pressure_(fieldOf(device, gpu::Format::r16F, settings.box.cells)),
      scalar_(fieldOf(device, gpu::Format::r16F, settings.box.cells)),
      solidVelocity_(fieldOf(device, gpu::Format::rgba16F, settings.box.cells)),
      solids_(fieldOf(device, gpu::Format::r8, settings.box.cells)),
      report_(device, "demo report", sizeof(Report)),
      vectors_(Advection{kernelOf(device, settings, demo_guess_comp, {{"FORMAT", "rgba16f"}}),
                         kernelOf(device, settings, demo_correct_comp,
                                  {{"FORMAT", "rgba16f"}, {"SOLID", "vec4(texelFetch(solidVelocity, c, 0).xyz, 0)"}})}),
      scalars_(Advection{kernelOf(device, settings, demo_guess_comp, {{"FORMAT", "r16f"}}),
                         kernelOf(device, settings, demo_correct_comp, {{"FORMAT", "r16f"}, {"SOLID", "vec4(0)"}})}),
      source_(kernelOf(device, settings, demo_source_comp)),
      curl_(kernelOf(device, settings, demo_curl_comp)),
      forces_(kernelOf(device, settings, demo_forces_comp)),
      divergence_(kernelOf(device, settings, demo_divergence_comp)),
      jacobi_(kernelOf(device, settings, demo_jacobi_comp)),
      project_(kernelOf(device, settings, demo_project_comp)),
      findReport_(kernelOf(device, settings, demo_report_comp)),
      shown_(kernelOf(device, settings, demo_shown_comp)) {}

void GlDemoSolver::setSolids(const flow::SolidMask& mask) {
    flow::check(mask, flow::CellLayout(settings_.box.cells));
    std::vector<std::uint8_t> solids(settings_.box.cellCount());
    std::vector<float> velocities(4 * solids.size());
    const glm::ivec3 cells = settings_.box.cells;
    std::size_t n = 0;
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i, ++n) {
                const std::uint8_t body = mask.body.empty() ? std::uint8_t{0} : mask.body[n];
                if (body == 0) continue;
                solids[n] = 255;
                const glm::vec3 velocity = mask.velocityOf(body, n, {i, j, k});
                for (int axis = 0; axis < 3; ++axis)
                    velocities[4 * n + static_cast<std::size_t>(axis)] = velocity[axis];
            }
    solids_.write(std::span<const std::uint8_t>(solids));
    solidVelocity_.write(std::span<const float>(velocities));
}

void GlDemoSolver::advect(Advection& by, const gpu::Texture& field, const gpu::Texture& guess,
                          const gpu::Texture& result, float cellsPerSpeed, float kept) {
    velocity_.bind(0);
    field.bind(1);
    guess.bindImage(0, false, true);
    by.guess.set("cellsPerSpeed", cellsPerSpeed);
    run(by.guess);
    guess.bind(2);
    result.bindImage(0, false, true);
    by.correct.set("cellsPerSpeed", cellsPerSpeed);
    by.correct.set("kept", kept);
    run(by.correct);
}

void GlDemoSolver::addSource(const flow::FluidSource& source, float seconds) {
    const flow::SourceReach reach = flow::reachOf(source, settings_.box);
    if (reach.empty()) return;
    velocity_.bindImage(0, true, true);
    density_.bindImage(1, true, true);
    temperature_.bindImage(2, true, true);
    source_.set("first", reach.first);
    source_.set("last", reach.last);
    source_.set("centre", glm::vec3(reach.centreCells));
    source_.set("speed", source.velocityMetresPerSecond);
    source_.set("perRadius", reach.perRadius);
    source_.set("addedDensity", source.densityPerSecond * seconds);
    source_.set("addedKelvin", source.kelvinPerSecond * seconds);
    source_.set("reaction", source.reaction);
    source_.set("taken", 1 - std::exp(-source.velocityPerSecond * seconds));
    source_.run(reach.last - reach.first + 1);
}

void GlDemoSolver::applyForces(float seconds) {
    velocity_.bind(0);
    vector_.bindImage(0, false, true);
    run(curl_);
    vector_.bind(1);
    density_.bind(2);
    temperature_.bind(3);
    otherVelocity_.bindImage(0, false, true);
    forces_.set("confinement", settings_.confinement());
    forces_.set("lift", settings_.lift(seconds));
    forces_.set("weight", settings_.weightPerDensity * seconds);
    forces_.set("airKelvin", airKelvin);
    forces_.set("lost", settings_.reactionLossPerSecond * seconds);
    run(forces_);
    std::swap(velocity_, otherVelocity_);
}

void GlDemoSolver::project() {
    velocity_.bind(0);
    vector_.bindImage(0, false, true);
    run(divergence_);
    pressure_.write(std::vector<float>(settings_.box.cellCount()));
    vector_.bind(1);
    for (int sweep = 0; sweep < jacobiSweeps; ++sweep) {
        pressure_.bind(0);
        scalar_.bindImage(0, false, true);
        run(jacobi_);
        std::swap(pressure_, scalar_);
    }
    velocity_.bind(0);
    pressure_.bind(1);
    otherVelocity_.bindImage(0, false, true);
    run(project_);
    std::swap(velocity_, otherVelocity_);
}

flow::StepReport GlDemoSolver::step(double stepSeconds, std::span<const flow::FluidSource> sources,
                                    const StageClock& clock) {
    flow::checkStep(stepSeconds);
    const auto seconds = static_cast<float>(stepSeconds);
    const float cellsPerSpeed = seconds / static_cast<float>(settings_.box.spacingMetres);
    solidVelocity_.bind(6);
    solids_.bind(7);
    {
        const auto timing = clock.measureDetail("advect");
        for (gpu::Texture* scalar : {&density_, &temperature_}) {
            advect(scalars_, *scalar, scalar_, pressure_, cellsPerSpeed, keptOfScalars);
            std::swap(*scalar, pressure_);
        }
        advect(vectors_, velocity_, vector_, otherVelocity_, cellsPerSpeed, 1);
        std::swap(velocity_, otherVelocity_);
    }
    {
        const auto timing = clock.measureDetail("forces");
        for (const flow::FluidSource& source : sources) addSource(source, seconds);
        applyForces(seconds);
    }
    {
        const auto timing = clock.measureDetail("project");
        project();
    }
    ++steps_;
    lastStepSeconds_ = stepSeconds;
    const Report report = read();
    for (const std::uint32_t bits : report)
        if (!std::isfinite(valueOf(bits)))
            throw SimulationError("fluid: after step " + std::to_string(steps_) + " a cell's state is not a number");
    flow::StepReport result;
    result.pressure.cycles = jacobiSweeps;
    result.pressure.residual = valueOf(report[3]);
    result.divergencePerStep = valueOf(report[3]) * cellsPerSpeed;
    result.cellsPerStep = std::max({valueOf(report[0]), valueOf(report[1]), valueOf(report[2])}) * cellsPerSpeed;
    return result;
}

/// Waits for the GPU.
GlDemoSolver::Report GlDemoSolver::read() const {
    gpu::Buffer& report = report_;
    report.clear();
    velocity_.bind(0);
    density_.bind(2);
    temperature_.bind(3);
    solidVelocity_.bind(6);
    solids_.bind(7);
    report.bindStorage(0);
    run(findReport_);
    Report values;
    report.read(std::span<std::uint32_t>(values));
    return values;
}

float GlDemoSolver::divergencePerStep() const {
    return valueOf(read()[3]) * static_cast<float>(lastStepSeconds_ / settings_.box.spacingMetres);
}

void GlDemoSolver::scroll(glm::ivec3) {
    throw std::logic_error("the demo's box cannot move");
}

void GlDemoSolver::gather(flow::Lane lane, std::span<float> to) const {
    const bool alone = lane == flow::density || lane == flow::temperature;
    const std::vector<float> values = (lane == flow::density       ? density_
                                       : lane == flow::temperature ? temperature_
                                                                   : velocity_)
                                          .readFloats();
    const std::size_t stride = alone ? 1 : 4, component = alone ? 0 : lane == flow::reaction ? 3 : lane;
    for (std::size_t c = 0; c < to.size(); ++c) to[c] = values[c * stride + component];
}

void GlDemoSolver::addDensity(std::span<const flow::AddedDensity>) {
    throw std::logic_error("the demo's box cannot move");
}

void GlDemoSolver::gather(flow::Lane lane, const gpu::Texture& to) const {
    const bool alone = lane == flow::density || lane == flow::temperature;
    (lane == flow::density ? density_ : lane == flow::temperature ? temperature_ : velocity_).bind(0);
    to.bindImage(0, false, true);
    shown_.set("component", alone ? 0 : lane == flow::reaction ? 3 : static_cast<int>(lane));
    run(shown_);
}

std::vector<float> GlDemoSolver::pressuresM2PerS2() const {
    std::vector<float> pressures = pressure_.readFloats();
    const std::vector<float> solid = solids_.readFloats();
    const auto scale = lastStepSeconds_ > 0 ? static_cast<float>(settings_.box.spacingMetres / lastStepSeconds_) : 0.0f;
    for (std::size_t c = 0; c < pressures.size(); ++c) pressures[c] = solid[c] > 0 ? 0 : pressures[c] * scale;
    return pressures;
}

std::uint64_t GlDemoSolver::stateHash() const {
    maths::Hash hash;
    std::vector<float> values(settings_.box.cellCount());
    for (std::size_t lane = 0; lane < flow::lanes; ++lane) {
        gather(static_cast<flow::Lane>(lane), values);
        hash.add(std::span<const float>(values));
    }
    return hash.value();
}

MemoryReport GlDemoSolver::gpuMemory() const {
    std::size_t flow = 0;
    for (const gpu::Texture* field :
         {&velocity_, &otherVelocity_, &vector_, &density_, &temperature_, &pressure_, &scalar_})
        flow += field->bytes();
    return {{"demo flow", 0, flow},
            {"demo solids", 0, solidVelocity_.bytes() + solids_.bytes()},
            {"demo report", 0, report_.bytes()}};
}

}  // namespace dustbench::grid_fluid::demo
