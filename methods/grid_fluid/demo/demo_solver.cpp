#include "methods/grid_fluid/demo/demo_solver.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "methods/contract/errors.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/kit/maths/hash.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::demo {
namespace {

glm::ivec3 unit(int axis) {
    return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
}

/// The value of an advected field in a solid's cell.
float ofSolid(float, const glm::vec4&) {
    return 0;
}
glm::vec4 ofSolid(const glm::vec4&, const glm::vec4& solid) {
    return {solid.x, solid.y, solid.z, 0};
}

}  // namespace

DemoSolver::DemoSolver(const DemoSettings& settings, MemoryLedger& ledger)
    : settings_(checked(settings)),
      velocity_(settings.box.cells, ledger.account("demo velocity")),
      otherVelocity_(settings.box.cells, ledger.account("demo other velocity")),
      vector_(settings.box.cells, ledger.account("demo vector")),
      density_(settings.box.cells, ledger.account("demo density")),
      temperature_(settings.box.cells, ledger.account("demo temperature")),
      pressure_(settings.box.cells, ledger.account("demo pressure")),
      scalar_(settings.box.cells, ledger.account("demo scalar")),
      solid_(settings.box.cells, ledger.account("demo solids")) {}

template <typename Cell>
void DemoSolver::forCells(const Cell& cell) const {
    const glm::ivec3 cells = settings_.box.cells;
    parallel::forEachBlock(static_cast<std::size_t>(cells.z), 1, [&](std::size_t k, std::size_t) {
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i) cell(glm::ivec3(i, j, static_cast<int>(k)));
    });
}

void DemoSolver::setSolids(const flow::SolidMask& mask) {
    flow::check(mask, flow::CellLayout(settings_.box.cells));
    forCells([&](const glm::ivec3& c) {
        const std::uint8_t body = mask.body.empty() ? std::uint8_t{0} : mask.body[solid_.index(c)];
        glm::vec3 velocity(0);
        if (body > 0) velocity = mask.velocityOf(body, solid_.index(c), c);
        solid_.set(c, glm::vec4(velocity, body != 0 ? 1 : 0));
    });
}

glm::vec3 DemoSolver::neighbourVelocity(const Vectors& velocity, const glm::ivec3& c, int axis, int side) const {
    const glm::ivec3 other = c + (2 * side - 1) * unit(axis);
    if (isInside(other)) return isSolid(other) ? glm::vec3(solid_.at(other)) : glm::vec3(velocity.at(other));
    glm::vec3 own(velocity.at(c));
    if (settings_.sides[static_cast<std::size_t>(2 * axis + side)] == flow::Side::wall) own[axis] = 0;
    return own;
}

float DemoSolver::neighbourPressure(const Scalars& pressure, const glm::ivec3& c, int axis, int side) const {
    const glm::ivec3 other = c + (2 * side - 1) * unit(axis);
    if (isInside(other)) return isSolid(other) ? pressure.at(c) : pressure.at(other);
    return settings_.sides[static_cast<std::size_t>(2 * axis + side)] == flow::Side::open ? 0 : pressure.at(c);
}

float DemoSolver::divergenceAt(const glm::ivec3& c) const {
    float sum = 0;
    for (int axis = 0; axis < 3; ++axis)
        sum += 0.5f * (neighbourVelocity(velocity_, c, axis, 1)[axis] - neighbourVelocity(velocity_, c, axis, 0)[axis]);
    return sum;
}

template <typename Value>
void DemoSolver::advect(const DemoGrid<Value>& field, DemoGrid<Value>& guess, DemoGrid<Value>& result,
                        float cellsPerSpeed, float kept) {
    const auto within = [&](const glm::vec3& place) {
        return glm::clamp(place, glm::vec3(0), glm::vec3(settings_.box.cells - 1));
    };
    const auto way = [&](const glm::ivec3& c) { return cellsPerSpeed * glm::vec3(velocity_.at(c)); };
    forCells([&](const glm::ivec3& c) { guess.set(c, field.sampled(within(glm::vec3(c) - way(c)))); });
    forCells([&](const glm::ivec3& c) {
        if (isSolid(c)) return result.set(c, ofSolid(Value(0), solid_.at(c)));
        const Value value = guess.at(c) + 0.5f * (field.at(c) - guess.sampled(within(glm::vec3(c) + way(c))));
        const glm::vec3 began = within(glm::vec3(c) - way(c));
        Value minimum = field.at(glm::ivec3(glm::floor(began))), maximum = minimum;
        field.around(began, [&](const Value& node, float) {
            minimum = glm::min(minimum, node);
            maximum = glm::max(maximum, node);
        });
        result.set(c, kept * glm::clamp(value, minimum, maximum));
    });
}

void DemoSolver::addSource(const flow::FluidSource& source, float seconds) {
    const flow::SourceReach reach = flow::reachOf(source, settings_.box);
    const float taken = 1 - std::exp(-source.velocityPerSecond * seconds);
    for (glm::ivec3 c(0, 0, reach.first.z); c.z <= reach.last.z; ++c.z)
        for (c.y = reach.first.y; c.y <= reach.last.y; ++c.y)
            for (c.x = reach.first.x; c.x <= reach.last.x; ++c.x) {
                if (isSolid(c)) continue;
                const glm::vec3 d = (glm::vec3(c) - glm::vec3(reach.centreCells)) * reach.perRadius;
                const float strength = std::exp(-0.5f * glm::dot(d, d));
                const glm::vec4 u = velocity_.at(c);
                const glm::vec3 faster = strength * taken * (source.velocityMetresPerSecond - glm::vec3(u));
                velocity_.set(c, {glm::vec3(u) + faster, std::max(u.w, strength * source.reaction)});
                density_.set(c, density_.at(c) + strength * source.densityPerSecond * seconds);
                temperature_.set(c, temperature_.at(c) + strength * source.kelvinPerSecond * seconds);
            }
}

void DemoSolver::applyForces(float seconds) {
    forCells([&](const glm::ivec3& c) {
        glm::vec3 curl(0);
        if (!isSolid(c)) {
            const auto slope = [&](int axis) {
                return neighbourVelocity(velocity_, c, axis, 1) - neighbourVelocity(velocity_, c, axis, 0);
            };
            const glm::vec3 x = slope(0), y = slope(1), z = slope(2);
            curl = 0.5f * glm::vec3(y.z - z.y, z.x - x.z, x.y - y.x);
        }
        vector_.set(c, glm::vec4(curl, glm::length(curl)));
    });
    forCells([&](const glm::ivec3& c) {
        glm::vec4 u = velocity_.at(c);
        if (!isSolid(c)) {
            glm::vec3 g;
            for (int axis = 0; axis < 3; ++axis) g[axis] = vector_.at(c + unit(axis)).w - vector_.at(c - unit(axis)).w;
            glm::vec3 added =
                settings_.confinement() / std::sqrt(glm::dot(g, g) + 1e-12f) * glm::cross(g, glm::vec3(vector_.at(c)));
            const float warmer = temperature_.at(c);
            added.y += settings_.lift(seconds) * airKelvin * warmer / (airKelvin + warmer) -
                       settings_.weightPerDensity * seconds * density_.at(c);
            u = {glm::vec3(u) + added, std::max(u.w - settings_.reactionLossPerSecond * seconds, 0.0f)};
        }
        otherVelocity_.set(c, u);
    });
    velocity_.swap(otherVelocity_);
}

void DemoSolver::project() {
    forCells([&](const glm::ivec3& c) { vector_.set(c, {isSolid(c) ? 0.0f : divergenceAt(c), 0, 0, 0}); });
    pressure_.setAll(0);
    for (int sweep = 0; sweep < jacobiSweeps; ++sweep) {
        forCells([&](const glm::ivec3& c) {
            float sum = 0;
            for (int n = 0; n < 6; ++n) sum += neighbourPressure(pressure_, c, n >> 1, n & 1);
            scalar_.set(c, (sum - vector_.at(c).x) / 6);
        });
        pressure_.swap(scalar_);
    }
    forCells([&](const glm::ivec3& c) {
        glm::vec4 u = velocity_.at(c);
        for (int axis = 0; axis < 3 && !isSolid(c); ++axis) {
            u[axis] -= 0.5f * (neighbourPressure(pressure_, c, axis, 1) - neighbourPressure(pressure_, c, axis, 0));
            for (const int side : {0, 1}) {
                const glm::ivec3 other = c + (2 * side - 1) * unit(axis);
                const bool closes =
                    isInside(other) ? isSolid(other)
                                    : settings_.sides[static_cast<std::size_t>(2 * axis + side)] == flow::Side::wall;
                if (closes) u[axis] = neighbourVelocity(velocity_, c, axis, side)[axis];
            }
        }
        otherVelocity_.set(c, u);
    });
    velocity_.swap(otherVelocity_);
}

flow::StepReport DemoSolver::step(double stepSeconds, std::span<const flow::FluidSource> sources,
                                  const StageClock& clock) {
    flow::checkStep(stepSeconds);
    const auto seconds = static_cast<float>(stepSeconds);
    const auto spacing = static_cast<float>(settings_.box.spacingMetres);
    {
        const auto timing = clock.measureDetail("advect");
        for (Scalars* scalar : {&density_, &temperature_}) {
            advect(*scalar, scalar_, pressure_, seconds / spacing, keptOfScalars);
            scalar->swap(pressure_);
        }
        advect(velocity_, vector_, otherVelocity_, seconds / spacing, 1);
        velocity_.swap(otherVelocity_);
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
    requireNumbers();
    glm::vec3 maximum(0);
    const glm::ivec3 cells = settings_.box.cells;
    for (glm::ivec3 c(0); c.z < cells.z; ++c.z)
        for (c.y = 0; c.y < cells.y; ++c.y)
            for (c.x = 0; c.x < cells.x; ++c.x) maximum = glm::max(maximum, glm::abs(glm::vec3(velocity_.at(c))));
    flow::StepReport report;
    report.pressure.cycles = jacobiSweeps;
    report.divergencePerStep = divergencePerStep();
    report.pressure.residual = report.divergencePerStep * spacing / seconds;
    report.cellsPerStep = std::max({maximum.x, maximum.y, maximum.z}) * seconds / spacing;
    return report;
}

float DemoSolver::divergencePerStep() const {
    float maximum = 0;
    const glm::ivec3 cells = settings_.box.cells;
    for (glm::ivec3 c(0); c.z < cells.z; ++c.z)
        for (c.y = 0; c.y < cells.y; ++c.y)
            for (c.x = 0; c.x < cells.x; ++c.x)
                if (!isSolid(c)) maximum = std::max(maximum, std::fabs(divergenceAt(c)));
    return maximum * static_cast<float>(lastStepSeconds_ / settings_.box.spacingMetres);
}

void DemoSolver::requireNumbers() const {
    const glm::ivec3 cells = settings_.box.cells;
    for (glm::ivec3 c(0); c.z < cells.z; ++c.z)
        for (c.y = 0; c.y < cells.y; ++c.y)
            for (c.x = 0; c.x < cells.x; ++c.x) {
                const glm::vec4 u = velocity_.at(c);
                if (!std::isfinite(u.x + u.y + u.z + u.w + density_.at(c) + temperature_.at(c)))
                    throw SimulationError("fluid: after step " + std::to_string(steps_) + " the state of cell " +
                                          std::to_string(c.x) + ", " + std::to_string(c.y) + ", " +
                                          std::to_string(c.z) + " is not a number");
            }
}

void DemoSolver::scroll(glm::ivec3) {
    throw std::logic_error("the demo's box cannot move");
}

void DemoSolver::gather(flow::Lane lane, std::span<float> to) const {
    forCells([&](const glm::ivec3& c) {
        to[velocity_.index(c)] = lane == flow::density       ? density_.at(c)
                                 : lane == flow::temperature ? temperature_.at(c)
                                                             : velocity_.at(c)[lane == flow::reaction ? 3 : lane];
    });
}

void DemoSolver::addDensity(std::span<const flow::AddedDensity>) {
    throw std::logic_error("the demo's box cannot move");
}

void DemoSolver::gather(flow::Lane, const gpu::Texture&) const {
    throw std::logic_error("a fluid that is solved on the CPU has no textures");
}

std::vector<float> DemoSolver::pressuresM2PerS2() const {
    std::vector<float> pressures(settings_.box.cellCount());
    const auto scale = lastStepSeconds_ > 0 ? static_cast<float>(settings_.box.spacingMetres / lastStepSeconds_) : 0.0f;
    forCells([&](const glm::ivec3& c) { pressures[pressure_.index(c)] = isSolid(c) ? 0 : pressure_.at(c) * scale; });
    return pressures;
}

std::uint64_t DemoSolver::stateHash() const {
    maths::Hash hash;
    std::vector<float> values(settings_.box.cellCount());
    for (std::size_t lane = 0; lane < flow::lanes; ++lane) {
        gather(static_cast<flow::Lane>(lane), values);
        hash.add(std::span<const float>(values));
    }
    return hash.value();
}

}  // namespace dustbench::grid_fluid::demo
