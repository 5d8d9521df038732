// Tests the effect of moving and deforming solids on the air: speeds of their faces, and displaced volume.
#include "methods/grid_fluid/fluid_solids.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "methods/grid_fluid/emitters.h"
#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/grid_fluid/grid_fluid.h"
#include "methods/grid_fluid/test_bodies.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::grid_fluid {
namespace {

using std::numbers::pi;
constexpr double edge = 0.1;
constexpr glm::ivec3 cells{44, 40, 42};

/// A scene with one solid, and the flow around it after one step.
class Air {
 public:
    Air(scene::Mesh mesh, scene::SolidMotion motion) : solids_(prepared(std::move(mesh), motion)) {
        flow::FluidSettings settings;
        settings.box = {cells, edge, {0, 0, 0}};
        settings.divergencePerStep = 1e-5f;
        solver_.emplace(settings, ledger_);
    }
    void step(const scene::SolidPose& pose, std::shared_ptr<const scene::DeformedMesh> shape = nullptr) {
        scene::SceneState state;
        state.solids = {{pose, std::move(shape)}};
        solver_->setSolids(solids_.voxelise(solver_->box(), state));
        solver_->step(1.0 / 60, {});
        for (int axis = 0; axis < 3; ++axis) {
            speeds_[static_cast<std::size_t>(axis)].resize(solver_->box().cellCount());
            solver_->gatherStored(static_cast<flow::Lane>(flow::velocityX + axis),
                                  speeds_[static_cast<std::size_t>(axis)]);
        }
    }
    [[nodiscard]] bool isSolid(const glm::ivec3& cell) const { return solids_.bodies()[index(cell)] != 0; }
    /// The speed of the face towards the previous cell along an axis.
    [[nodiscard]] double speed(const glm::ivec3& cell, int axis) const {
        return static_cast<double>(speeds_[static_cast<std::size_t>(axis)][index(cell)]);
    }
    /// Calls `take(cell, axis, outwards)` for each face between a cell and the previous one if exactly one of them is
    /// solid; `outwards` is 1 if the solid is behind the face.
    template <typename Take>
    void forSurface(const Take& take) const {
        forFaces([&](const glm::ivec3& cell, const glm::ivec3& before, int axis) {
            if (isSolid(cell) != isSolid(before)) take(cell, axis, isSolid(before) ? 1.0 : -1.0);
        });
    }
    /// Outflow through the surface of a box of cells.
    [[nodiscard]] double flowOutOf(const glm::ivec3& first, const glm::ivec3& last) const {
        const auto isIn = [&](const glm::ivec3& cell) {
            return glm::all(glm::greaterThanEqual(cell, first)) && glm::all(glm::lessThanEqual(cell, last));
        };
        double sum = 0;
        forFaces([&](const glm::ivec3& cell, const glm::ivec3& before, int axis) {
            if (isIn(cell) != isIn(before)) sum += (isIn(before) ? 1 : -1) * speed(cell, axis);
        });
        return sum * edge * edge;
    }

 private:
    FluidSolids prepared(scene::Mesh mesh, scene::SolidMotion motion) {
        scene_.solids = {{"it", std::make_shared<scene::Mesh>(std::move(mesh)), motion}};
        scene_.solidPoses.resize(1);
        return {scene_, cells, ledger_.account("solids")};
    }
    static std::size_t index(const glm::ivec3& cell) {
        return static_cast<std::size_t>(cell.x + cells.x * (cell.y + cells.y * cell.z));
    }
    template <typename Take>
    static void forFaces(const Take& take) {
        for (int k = 0; k < cells.z; ++k)
            for (int j = 0; j < cells.y; ++j)
                for (int i = 0; i < cells.x; ++i)
                    for (int axis = 0; axis < 3; ++axis) {
                        const glm::ivec3 cell(i, j, k);
                        glm::ivec3 before = cell;
                        before[axis] -= 1;
                        if (before[axis] >= 0) take(cell, before, axis);
                    }
    }

    scene::Scene scene_;
    MemoryLedger ledger_;
    FluidSolids solids_;
    std::optional<flow::FluidSolver> solver_;
    std::array<std::vector<float>, 3> speeds_;
};

/// World position of the face towards the previous cell.
glm::dvec3 middleOf(const glm::ivec3& cell, int axis) {
    glm::dvec3 place = glm::dvec3(cell) + 0.5;
    place[axis] -= 0.5;
    return place * edge;
}

TEST(FluidSolids, ASphereOnItsWayPushesTheAirAheadAtItsOwnSpeed) {
    Air air(ball(32), scene::SolidMotion::moves);
    const double radius = 1.0;
    const glm::vec3 velocity(0.7f, -0.3f, 0.2f);
    for (int n = 0; n < 6; ++n) {
        scene::SolidPose pose{glm::mat4(placed(glm::dvec3(2, 1.9, 2.1) + glm::dvec3(velocity) * (n / 7.0), radius)),
                              velocity, glm::vec3(0)};
        air.step(pose);
        glm::dvec3 ahead(0), behind(0);
        air.forSurface([&](const glm::ivec3& cell, int axis, double outwards) {
            EXPECT_EQ(air.speed(cell, axis), static_cast<double>(velocity[axis]));
            const double flux = outwards * air.speed(cell, axis) * edge * edge;
            (flux > 0 ? ahead : behind)[axis] += flux;
        });
        for (int axis = 0; axis < 3; ++axis) {
            const double disc = std::abs(static_cast<double>(velocity[axis])) * pi * radius * radius;
            EXPECT_NEAR(ahead[axis], disc, 0.02 * disc) << n;
            EXPECT_NEAR(ahead[axis], -behind[axis], 1e-6) << n;
        }
        EXPECT_NEAR(air.flowOutOf({5, 5, 5}, {38, 34, 36}), 0, 1e-3) << "the displaced air flows in behind it";
    }
}

TEST(FluidSolids, TheSurfaceOfWhatTurnsHasTheSpeedOfItsPlace) {
    Air air(block({1.4f, 0.5f, 0.9f}), scene::SolidMotion::moves);
    const glm::vec3 velocity(0.1f, 0.4f, -0.2f), spin(1.5f, -0.7f, 2.2f);
    const glm::dvec3 centre(2.13, 1.95, 2.08);
    const glm::dmat4 toWorld =
        glm::rotate(glm::translate(glm::dmat4(1), centre), 0.7, glm::dvec3(1, 2, 3) / std::sqrt(14));
    air.step({glm::mat4(toWorld), velocity, spin});
    int faces = 0;
    air.forSurface([&](const glm::ivec3& cell, int axis, double) {
        const glm::dvec3 expected = glm::dvec3(velocity) + glm::cross(glm::dvec3(spin), middleOf(cell, axis) - centre);
        EXPECT_NEAR(air.speed(cell, axis), expected[axis], 2e-6);
        ++faces;
    });
    EXPECT_GT(faces, 300);
}

/// The unit ball, with the velocity `rates`·p at each point p.
std::shared_ptr<const scene::DeformedMesh> swelling(const scene::Mesh& mesh, const glm::vec3& rates) {
    auto shape = std::make_shared<scene::DeformedMesh>(scene::DeformedMesh{mesh, {}});
    for (const glm::vec3& position : mesh.positions) shape->velocities.push_back(rates * position);
    return shape;
}

TEST(FluidSolids, ASphereThatSwellsDisplacesItsVolumesRate) {
    const scene::Mesh mesh = ball(48);
    Air air(mesh, scene::SolidMotion::deforms);
    const double radius = 0.97;
    const glm::dvec3 centre(2.03, 1.98, 2.11);
    const scene::SolidPose pose{glm::mat4(placed(centre, radius)), {}, {}};
    for (const glm::vec3 rates : {glm::vec3(0.5f), glm::vec3(-0.3f), glm::vec3(0.9f, -0.2f, 0.1f)}) {
        air.step(pose, swelling(mesh, rates));
        double displaced = 0;
        air.forSurface([&](const glm::ivec3& cell, int axis, double outwards) {
            displaced += outwards * air.speed(cell, axis) * edge * edge;
            // The sphere's speed at its intersection with the line through the centres of both cells.
            glm::dvec3 place = middleOf(cell, axis) - centre;
            place[axis] = 0;
            const double height = std::sqrt(std::max(0.0, radius * radius - glm::dot(place, place)));
            if (height > edge) {  // otherwise the ball is only one cell thick there, and both sides have the mean
                EXPECT_NEAR(air.speed(cell, axis), outwards * static_cast<double>(rates[axis]) * height, 0.01);
            }
        });
        // ∮ v·n dA = ∫ ∇·v dV
        const double rate = static_cast<double>(rates.x + rates.y + rates.z) * 4 / 3 * pi * std::pow(radius, 3);
        EXPECT_NEAR(displaced, rate, 0.01 * std::abs(rate));
        EXPECT_NEAR(air.flowOutOf({5, 5, 5}, {38, 34, 36}), rate, 0.01 * std::abs(rate));
    }
}

TEST(FluidSolids, VelocitiesThatAllVerticesShareAreThoseOfEveryCell) {
    MemoryLedger ledger;
    MeshCells found({24, 20, 22}, ledger.account("cells"));
    std::mt19937 engine(17);
    std::uniform_real_distribution<double> share(-1, 1);
    const auto vector = [&] { return glm::dvec3(share(engine), share(engine), share(engine)); };
    for (int n = 0; n < 60; ++n) {
        const scene::Mesh mesh = n % 2 == 0 ? block({8, 6, n % 4 == 0 ? 0.1f : 5.0f}) : ball(3 + n % 7);
        const double scale = n % 2 == 0 ? 1.0 : 4.0 + 3 * share(engine);
        const glm::dmat4 place =
            glm::scale(glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(12, 10, 11) + 6.0 * vector()),
                                   3 * share(engine), vector()),
                       glm::dvec3(scale));
        const glm::vec3 velocity(vector());
        found.clear();
        found.add(mesh, place, 3, std::vector<glm::vec3>(mesh.positions.size(), velocity));
        std::size_t filled = 0;
        for (std::size_t c = 0; c < found.bodies().size(); ++c) {
            if (found.bodies()[c] == 0) continue;
            ++filled;
            EXPECT_LT(glm::distance(found.velocities()[c], velocity), 1e-6f) << n;
        }
        EXPECT_GT(filled, 10u) << n;
        // The cells are the same as without velocities.
        MeshCells rigid({24, 20, 22}, ledger.account("cells"));
        rigid.add(mesh, place, 3);
        EXPECT_TRUE(std::ranges::equal(found.bodies(), rigid.bodies())) << n;
    }
}

TEST(CellsOnRays, AreThoseThatTheCpuFinds) {
    MemoryLedger ledger;
    constexpr glm::ivec3 size{29, 20, 23};
    flow_gl::CellsOnRays rays(TestMoment::device(), size);
    MeshCells onGpu(size, ledger.account("cells"), &rays), onCpu(size, ledger.account("cells"));
    std::mt19937 engine(23);
    std::uniform_real_distribution<double> share(-1, 1);
    const auto vector = [&] { return glm::dvec3(share(engine), share(engine), share(engine)); };
    std::size_t filled = 0;
    for (int n = 0; n < 60; ++n) {
        onGpu.clear();
        onCpu.clear();
        for (MeshCells* found : {&onGpu, &onCpu}) found->set(3, 4, 5, 9);
        for (std::uint8_t body = 1; body <= 3; ++body) {
            // Balls, walls thinner than a cell, and rough heaps of triangles whose surfaces run through each other.
            scene::Mesh mesh = (n + body) % 3 == 0 ? block({1, 1, 0.01f}) : ball(2 + (n + body) % 5);
            if ((n + body) % 3 == 1)
                for (glm::vec3& position : mesh.positions) position += 0.3f * glm::vec3(vector());
            const glm::dmat4 turned = glm::rotate(
                glm::translate(glm::dmat4(1), glm::dvec3(size) * (0.5 + 0.4 * vector())), 3 * share(engine), vector());
            const glm::dmat4 toCells = glm::scale(turned, 4.0 + 5.0 * glm::abs(vector()));
            for (MeshCells* found : {&onGpu, &onCpu}) found->add(mesh, toCells, body);
        }
        // Aligned with the lattice: edges and corners are on rays.
        const glm::dmat4 onLattice = placed({12.5, 9.5, 8.5}, 4);
        for (MeshCells* found : {&onGpu, &onCpu}) {
            found->add(block(glm::vec3(1)), onLattice, 4);
            found->finish();
        }
        EXPECT_TRUE(std::ranges::equal(onGpu.bodies(), onCpu.bodies())) << n;
        filled +=
            static_cast<std::size_t>(std::ranges::count_if(onCpu.bodies(), [](std::uint8_t b) { return b != 0; }));
    }
    EXPECT_GT(filled, 60 * 200u);
}

GridFluidSettings plumeSettings() {
    GridFluidSettings settings;
    settings.setup = readFluid(files::dataFolder() / "fluids/plume.toml");
    settings.solver.forces = settings.setup.forces;
    settings.solver.box.cells = {20, 24, 20};
    settings.solver.box.spacingMetres = settings.setup.lengthMetres / 20;
    settings.solver.advection.limit = flow::Limit::revert;
    settings.picture.backend = raycast::Backend::gl;
    return settings;
}

/// State after ten steps of a plume around a ball; `wobble` in metres and as a share of its radius.
std::optional<std::uint64_t> hashAfter(scene::SolidMotion motion, SolverBackend solver, float wobble) {
    TestMoment moment(0, 32, 32, {0, 2, 8}, {0, 0, -1});
    const auto mesh = std::make_shared<scene::Mesh>(ball(8));
    moment.scene.solids = {{"ball", mesh, motion}};
    moment.scene.solidPoses = {{glm::mat4(placed({0.1, 0.8, 0}, 0.5)), {}, {}}};
    GridFluidSettings settings = plumeSettings();
    settings.solverBackend = solver;
    GridFluid method(settings);
    method.prepare(moment.scene, {.seed = 3}, TestMoment::device());
    for (int step = 0; step < 10; ++step) {
        if (motion != scene::SolidMotion::still) {
            scene::SolidNow now{moment.scene.solidPoses[0], nullptr};
            const float angle = 0.5f * static_cast<float>(step);
            now.pose.toWorld[3].x += wobble * std::sin(angle);
            if (wobble > 0) now.pose.velocity.x = 30 * wobble * std::cos(angle);
            if (motion == scene::SolidMotion::deforms) now.shape = swelling(*mesh, glm::vec3(wobble * std::cos(angle)));
            moment.state.solids = {now};
        }
        method.update(moment.frame());
    }
    return method.stateHash();
}

TEST(FluidSolids, WhatStandsIsAsIfItWereStillBitForBit) {
    using enum scene::SolidMotion;
    for (const SolverBackend solver : {SolverBackend::cpu, SolverBackend::openGl}) {
        const auto still = hashAfter(scene::SolidMotion::still, solver, 0);
        EXPECT_EQ(hashAfter(moves, solver, 0), still);
        EXPECT_EQ(hashAfter(deforms, solver, 0), still);
        EXPECT_NE(hashAfter(moves, solver, 0.1f), still);
        EXPECT_NE(hashAfter(deforms, solver, 0.1f), still);
    }
}

TEST(FluidSolids, DoNotDependOnTheNumberOfThreads) {
    for (const scene::SolidMotion motion : {scene::SolidMotion::moves, scene::SolidMotion::deforms}) {
        const auto expected = hashAfter(motion, SolverBackend::cpu, 0.1f);
        for (const int threads : {1, 3})
            tbb::task_arena(threads).execute(
                [&] { EXPECT_EQ(hashAfter(motion, SolverBackend::cpu, 0.1f), expected) << threads; });
    }
}

TEST(FluidSolids, SourcesOnASolidGoWithIt) {
    scene::Scene scene;
    const auto mesh = std::make_shared<scene::Mesh>(ball(12));
    scene.solids = {{"ball", mesh, scene::SolidMotion::deforms}};
    scene.solidPoses = {{glm::mat4(placed({1, 2, 3}, 0.5)), {}, {}}};
    SourceSetup setup;
    setup.at = SourceAt::solid;
    setup.solid = "ball";
    setup.balls = 20;
    const std::vector<SourceSetup> setups{setup};
    Emitters emitters(setups, scene, 1);
    scene::SceneState state;
    auto shape = std::make_shared<scene::DeformedMesh>(scene::DeformedMesh{*mesh, {}});
    for (glm::vec3& position : shape->mesh.positions) position *= 3;
    const glm::dmat4 place = glm::rotate(placed({-4, 1, 0}, 0.5), 1.0, glm::dvec3(0, 0, 1));
    state.solids = {{{glm::mat4(place), {}, {}}, shape}};
    const auto before = emitters.at({}, 0, 1.0 / 60, 0);
    const std::vector<flow::FluidSource> first(before.begin(), before.end());
    const auto after = emitters.at(state, 1, 1.0 / 60, 0);
    ASSERT_EQ(after.size(), 20u);
    for (std::size_t n = 0; n < 20; ++n) {
        const glm::dvec3 local = (first[n].centreMetres - glm::dvec3(1, 2, 3)) / 0.5;
        EXPECT_NEAR(glm::length(local), 1, 0.05);
        EXPECT_LT(glm::distance(after[n].centreMetres, glm::dvec3(place * glm::dvec4(3.0 * local, 1))), 1e-5);
    }
}

TEST(FluidSolids, RefuseMoreThanTheyCanTellApart) {
    MemoryLedger ledger;
    scene::Scene scene;
    scene.id = "crowd";
    const auto mesh = std::make_shared<scene::Mesh>(ball(3));
    scene.solids.assign(249, {"one", mesh, scene::SolidMotion::moves});
    scene.solidPoses.resize(249);
    EXPECT_NO_THROW(FluidSolids(scene, {8, 8, 8}, ledger.account("cells")));
    scene.solids.push_back(scene.solids[0]);
    scene.solidPoses.resize(250);
    EXPECT_EQ(inputError([&] {
                  FluidSolids(scene, {8, 8, 8}, ledger.account("cells"));
              }),
              "solids of scene 'crowd': got 250 that move, allowed in a fluid: at most 249");
}

}  // namespace
}  // namespace dustbench::grid_fluid
