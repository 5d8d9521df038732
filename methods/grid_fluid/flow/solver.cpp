#include "methods/grid_fluid/flow/solver.h"

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "methods/contract/errors.h"
#include "methods/kit/maths/hash.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr std::array<std::string_view, lanes> laneNames{"velocity x", "velocity y",  "velocity z",
                                                        "density",    "temperature", "reaction"};

void requireAtLeastNothing(const char* name, float value) {
    if (!(value >= 0) || !std::isfinite(value))
        throw InputError(std::string(name) + ": got " + std::to_string(value) + ", allowed: 0 or more");
}

}  // namespace

void check(const FluidSettings& settings) {
    check(settings.box);
    const ForceSettings& forces = settings.forces;
    requireAtLeastNothing("confinement", forces.confinementPerSecond);
    requireAtLeastNothing("decay of the density", forces.densityDecayPerSecond);
    requireAtLeastNothing("cooling", forces.coolingPerSecond);
    requireAtLeastNothing("loss of the reaction", forces.reactionLossPerSecond);
    requireAtLeastNothing("viscosity", forces.viscosityM2PerSecond);
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(settings.windMetresPerSecond[axis]))
            throw InputError("wind: got " + std::to_string(settings.windMetresPerSecond[axis]) +
                             ", allowed: metres per second");
    if (!(settings.divergencePerStep > 0))
        throw InputError("divergence: got " + std::to_string(settings.divergencePerStep) + ", allowed: more than 0");
    if (settings.jacobiSweeps < 0)
        throw InputError("jacobi sweeps: got " + std::to_string(settings.jacobiSweeps) + ", allowed: 0 or more");
}

void checkStep(double stepSeconds) {
    if (!(stepSeconds > 0) || !std::isfinite(stepSeconds))
        throw InputError("step: got " + std::to_string(stepSeconds) + " s, allowed: more than 0");
}

int diffusionParts(const FluidSettings& settings, float stepSeconds) {
    const auto spacing = static_cast<float>(settings.box.spacingMetres);
    const float viscosity = settings.forces.viscosityM2PerSecond;
    const float parts = std::ceil(viscosity * stepSeconds / (spacing * spacing) * 8);
    if (parts > 1000)
        throw InputError("viscosity: got " + std::to_string(viscosity) + " m2/s, allowed: up to " +
                         std::to_string(viscosity * 1000 / parts) + " at this step and spacing");
    return static_cast<int>(parts);
}

std::uint64_t hashOf(const CellField& cells, const CellLayout& layout) {
    maths::Hash hash;
    for (std::size_t r = 0; r < layout.rows(); ++r)
        hash.add(std::span<const float>(cells.cell(layout.at(0, layout.rowJ(r), layout.rowK(r))),
                                        static_cast<std::size_t>(layout.nx) * lanes));
    return hash.value();
}

void throwLostNumber(const CellField& cells, const CellLayout& layout, std::int64_t steps) {
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i)
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    if (!std::isfinite(cells.cell(layout.at(i, j, k))[lane]))
                        throw SimulationError("fluid: after step " + std::to_string(steps) + " the " +
                                              std::string(laneNames[lane]) + " of cell " + std::to_string(i) + ", " +
                                              std::to_string(j) + ", " + std::to_string(k) + " is not a number");
    throw std::logic_error("fluid: a state was reported as not finite, but all of its values are finite");
}

}  // namespace dustbench::grid_fluid::flow
