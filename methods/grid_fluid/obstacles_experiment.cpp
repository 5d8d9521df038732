#include "methods/grid_fluid/obstacles_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <string>
#include <vector>

#include "methods/grid_fluid/demo/demo_solver.h"
#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/grid_fluid/mesh_cells.h"

namespace dustbench::grid_fluid::obstacles {
namespace {

constexpr glm::ivec3 cells{44, 24, 24};
constexpr double edge = 0.1;
constexpr double stepSeconds = 1.0 / 30;
constexpr int steps = 50;
constexpr double radius = 0.5;
constexpr glm::dvec3 wallPlace{2.4, 1.2, 1.2};  ///< point where the jet meets the wall

std::size_t index(const glm::ivec3& cell) {
    return static_cast<std::size_t>(cell.x + cells.x * (cell.y + cells.y * cell.z));
}

glm::dvec3 centreOf(const glm::ivec3& cell) {
    return (glm::dvec3(cell) + 0.5) * edge;
}

template <typename Function>
void forCells(const Function& function) {
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i) function(glm::ivec3(i, j, k));
}

using Bodies = std::vector<std::uint8_t>;

Bodies ballAt(const glm::dvec3& centre, bool perforated) {
    Bodies bodies;
    forCells([&](const glm::ivec3& cell) {
        const bool isHole = perforated && (cell.x + cell.y + cell.z) % 4 == 0;
        bodies.push_back(glm::distance(centreOf(cell), centre) < radius && !isHole ? 1 : 0);
    });
    return bodies;
}

/// Its first axis is the wall's normal.
glm::dmat4 wallToWorld() {
    const glm::dmat4 placed = glm::translate(glm::dmat4(1), wallPlace);
    return glm::rotate(glm::rotate(placed, 0.35, glm::dvec3(0, 0, 1)), 0.2, glm::dvec3(0, 1, 0));
}

bool isBehindWall(const glm::dvec3& place) {
    return glm::dot(place - wallPlace, glm::dvec3(wallToWorld()[0])) > 0;
}

scene::Mesh unitBox() {
    scene::Mesh mesh;
    for (int n = 0; n < 8; ++n) mesh.positions.push_back(glm::vec3(n & 1, n >> 1 & 1, n >> 2) - 0.5f);
    using Side = std::array<std::uint32_t, 4>;
    for (const Side& side :
         {Side{0, 4, 6, 2}, Side{1, 3, 7, 5}, Side{0, 1, 5, 4}, Side{2, 6, 7, 3}, Side{0, 2, 3, 1}, Side{4, 5, 7, 6}})
        for (const std::size_t corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(side[corner]);
    return mesh;
}

Bodies wall(bool holed) {
    MemoryLedger ledger;
    MeshCells found(cells, ledger.account("cells"));
    const glm::dmat4 toCells = glm::scale(glm::dmat4(1), glm::dvec3(1 / edge)) * wallToWorld();
    found.add(unitBox(), glm::scale(toCells, glm::dvec3(0.1 * edge, 20, 20)), 1);
    Bodies bodies(found.bodies().begin(), found.bodies().end());
    if (holed)
        forCells([&](const glm::ivec3& cell) {
            const glm::dvec3 away = glm::abs(centreOf(cell) - wallPlace) / edge;
            if (away.y < 2 && away.z < 2) bodies[index(cell)] = 0;
        });
    return bodies;
}

/// A solver and its stored state.
class Flow {
 public:
    explicit Flow(bool asPublished) : asPublished_(asPublished) {
        flow::FluidSettings settings;
        settings.box = {cells, edge, {0, 0, 0}};
        if (asPublished)
            solver_ = std::make_unique<demo::DemoSolver>(demo::demoOf(settings, false), ledger_);
        else
            solver_ = std::make_unique<flow::FluidSolver>(settings, ledger_);
    }
    [[nodiscard]] flow::Solver& solver() { return *solver_; }

    void gather() {
        for (int axis = 0; axis < 3; ++axis)
            solver_->gatherStored(static_cast<flow::Lane>(flow::velocityX + axis),
                                  speeds_[static_cast<std::size_t>(axis)]);
        solver_->gather(flow::density, density_);
    }
    [[nodiscard]] double density(const glm::ivec3& cell) const { return static_cast<double>(density_[index(cell)]); }
    /// Speed of the face towards the previous cell along an axis; the mean of both cells if speeds are at the centres.
    [[nodiscard]] double faceSpeed(const glm::ivec3& cell, int axis) const {
        const std::vector<float>& speeds = speeds_[static_cast<std::size_t>(axis)];
        const auto here = static_cast<double>(speeds[index(cell)]);
        if (!asPublished_) return here;
        glm::ivec3 before = cell;
        --before[axis];
        return 0.5 * (here + static_cast<double>(speeds[index(before)]));
    }

 private:
    bool asPublished_;
    MemoryLedger ledger_;
    std::unique_ptr<flow::Solver> solver_;
    const std::size_t count_ = flow::FluidBox{cells, edge, {}}.cellCount();
    std::array<std::vector<float>, 3> speeds_{std::vector<float>(count_), std::vector<float>(count_),
                                              std::vector<float>(count_)};
    std::vector<float> density_ = std::vector<float>(count_);
};

/// Inflow through the faces between the ball's cells and others, relative to the ball.
double inflow(const Flow& flow, const Bodies& ball, const glm::vec3& ballVelocity) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
        forCells([&](const glm::ivec3& cell) {
            if (cell[axis] == 0) return;
            glm::ivec3 before = cell;
            --before[axis];
            const bool isIn = ball[index(cell)] != 0, wasIn = ball[index(before)] != 0;
            if (isIn == wasIn) return;
            const double speed = flow.faceSpeed(cell, axis) - static_cast<double>(ballVelocity[axis]);
            sum += std::max(isIn ? speed : -speed, 0.0);
        });
    return sum * edge * edge;
}

double smokeInside(const Flow& flow, const Bodies& bodies) {
    double within = 0, around = 0;
    forCells([&](const glm::ivec3& cell) {
        double& maximum = bodies[index(cell)] != 0 ? within : around;
        maximum = std::max(maximum, flow.density(cell));
    });
    return around > 0 ? within / around : 0;
}

double smokeBehind(const Flow& flow) {
    double behind = 0, all = 0;
    forCells([&](const glm::ivec3& cell) {
        all += flow.density(cell);
        if (isBehindWall(centreOf(cell))) behind += flow.density(cell);
    });
    return behind / all;
}

flow::FluidSource jet(float metresPerSecond) {
    flow::FluidSource source;
    source.centreMetres = {0.9, 1.2, 1.2};
    source.radiusMetres = 0.3;
    source.densityPerSecond = 4;
    source.velocityMetresPerSecond = {metresPerSecond, 0, 0};
    source.velocityPerSecond = 30;
    return source;
}

}  // namespace

ObstacleReport measureObstacle(const ObstacleSettings& settings) {
    using enum Obstacle;
    const bool isWall = settings.obstacle == wall || settings.obstacle == holedWall;
    const bool isBall = settings.obstacle == ball || settings.obstacle == perforatedBall;
    Flow flow(settings.asPublished);
    const flow::FluidSource source = jet(settings.jetMetresPerSecond);
    flow::BodyMotion motion;
    motion.velocity = {-settings.ballMetresPerSecond, 0, 0};
    Bodies solid;
    if (isWall) flow.solver().setSolids({solid = obstacles::wall(settings.obstacle == holedWall), {}});
    ObstacleReport report;
    for (int step = 0; step < steps; ++step) {
        const glm::dvec3 centre = glm::dvec3(2.6, 1.2, 1.2) + glm::dvec3(motion.velocity) * (stepSeconds * step);
        if (isBall)
            flow.solver().setSolids({solid = ballAt(centre, settings.obstacle == perforatedBall), {&motion, 1}});
        flow.solver().step(stepSeconds, {&source, 1}, StageClock());
        flow.gather();
        if (!solid.empty()) report.smokeInside = std::max(report.smokeInside, smokeInside(flow, solid));
        if (!isWall)
            report.inflowM3PerSecond =
                std::max(report.inflowM3PerSecond, inflow(flow, ballAt(centre, false), motion.velocity));
    }
    report.smokeBehind = smokeBehind(flow);
    return report;
}

namespace {

std::vector<Finding> measureBoth() {
    using enum Obstacle;
    std::vector<Finding> findings;
    for (const bool asPublished : {false, true}) {
        const auto measured = [&](Obstacle obstacle, float ballSpeed = 0, float jetSpeed = 3) {
            return measureObstacle({asPublished, obstacle, ballSpeed, jetSpeed});
        };
        const auto found = [&](const char* quantity, double value, int runs = 1) {
            const std::string name = std::string(quantity) + (asPublished ? "_demo" : "_ours");
            findings.push_back({name, value, value, value, runs * steps});
        };
        const ObstacleReport nothing = measured(none), rest = measured(ball), moving = measured(ball, 0.5f);
        const ObstacleReport behind = measured(wall), fast = measured(wall, 0, 12);
        found("inflow_rest", rest.inflowM3PerSecond / nothing.inflowM3PerSecond);
        found("inflow_moving", moving.inflowM3PerSecond / measured(none, 0.5f).inflowM3PerSecond);
        found("inflow_perforated", measured(perforatedBall).inflowM3PerSecond / nothing.inflowM3PerSecond);
        found("smoke_inside", std::max({rest.smokeInside, moving.smokeInside, behind.smokeInside}), 3);
        found("behind_wall", behind.smokeBehind);
        found("behind_wall_fast", fast.smokeBehind);
        found("behind_hole", measured(holedWall).smokeBehind);
        found("behind_nothing", nothing.smokeBehind);
    }
    return findings;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures leaks into obstacles: air and smoke into a ball, smoke through a thin wall.";
    info.source = "Senger2009";
    info.run = [](ExperimentContext&) { return measureBoth(); };
    return info;
}

}  // namespace dustbench::grid_fluid::obstacles
