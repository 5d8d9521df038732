#include "methods/voxel_shape/shape_colours.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

VoxelGrid greySphere(MemoryLedger& ledger) {
    const scene::Mesh sphere = sphereMesh(1, 40);
    VoxelGrid grid(ledger, surfaceVoxels(sphere, latticeAround(sphere, 40)), Voxel());
    for (const std::uint32_t i : grid.active()) {
        grid.voxels()[i].colour = PackedColour({0.5f, 0.5f, 0.5f, 0.4f});
        grid.voxels()[i].fadingColour = PackedColour({0.25f, 0.25f, 0.25f, 0.1f});
    }
    return grid;
}

scene::Lights sunAlong(const glm::vec3& toSun) {
    scene::Lights lights;
    lights.toSun = toSun;
    lights.sun = glm::vec3(0.8f);
    lights.ambient = glm::vec3(0.2f);
    return lights;
}

/// Checks that the side towards the sun has ambient + sun, and the opposite side only ambient.
void expectLitFrom(const VoxelGrid& grid, const glm::vec3& direction) {
    float front = 0, back = 1;
    for (const std::uint32_t i : grid.active()) {
        const float height = glm::dot(grid.lattice().centre(grid.lattice().cell(i)), direction);
        const float shown = grid.voxels()[i].colour.colour().r;
        if (height > 0.9f) front = std::max(front, shown);
        if (height < -0.3f) back = std::min(back, shown);
        EXPECT_NEAR(grid.voxels()[i].colour.colour().a, 0.4f, 1e-4f);
        EXPECT_NEAR(grid.voxels()[i].fadingColour.colour().r, shown / 2, 1e-4f) << "half as bright, in the same light";
    }
    EXPECT_NEAR(front, 0.5f * (0.2f + 0.8f), 0.01f);
    EXPECT_NEAR(back, 0.5f * 0.2f, 0.01f);
}

TEST(ShapeLight, ShowsSunAndSkyBeforeAndTheSkyAloneBehind) {
    MemoryLedger ledger;
    VoxelGrid grid = greySphere(ledger);
    ShapeLight light(ledger, grid, sunAlong({0, 1, 0}));
    light.shineOn(grid, {});
    expectLitFrom(grid, {0, 1, 0});
}

TEST(ShapeLight, StandsStillWhereTheShapeTurns) {
    MemoryLedger ledger;
    VoxelGrid grid = greySphere(ledger);
    ShapeLight light(ledger, grid, sunAlong({0, 1, 0}));
    light.shineOn(grid, {});
    Pose pose;
    pose.rotation = glm::mat3(glm::rotate(glm::mat4(1), glm::radians(90.0f), {0, 0, 1}));
    light.shineOn(grid, pose);
    expectLitFrom(grid, glm::transpose(pose.rotation) * glm::vec3(0, 1, 0));
    light.shineOn(grid, {});
    expectLitFrom(grid, {0, 1, 0});
}

constexpr float dt = 1.0f / 60;
constexpr int steps = 30;
const glm::vec3 grey(0.4f), red(0.9f, 0.1f, 0.0f);

/// Two adjacent voxels with 4000 particles each; `force` acts in the first.
struct Pair {
    Pair(float edge, Force kind, const glm::vec3& force, float fullMetres)
        : system(ledger, marked(edge), pattern(), 3), stress(start(kind, force, fullMetres)) {}

    static MarkedVoxels marked(float edge) {
        MarkedVoxels two(Lattice{{2, 1, 1}, glm::vec3(0), edge});
        std::ranges::fill(two.marked, std::uint8_t{1});
        std::ranges::fill(two.colours, grey);
        return two;
    }
    static Voxel pattern() {
        Voxel voxel;
        voxel.setActive(true);
        return voxel;
    }
    ShapeStress start(Force kind, const glm::vec3& force, float fullMetres) {
        for (Voxel& voxel : system.grid().voxels()) {
            voxel.colour = voxel.fadingColour = PackedColour(glm::vec4(grey, 0.5f));
            voxel.lifetimeSeconds = 1;
        }
        system.grid().voxels()[0].setForce(kind, force, 0);
        system.grid().shareOut(8000);
        return {ledger, system, {red, fullMetres}};
    }
    void run(const std::function<Pose(int)>& poseAt) {
        for (int step = 0; step <= steps; ++step) system.step(poseAt(step), {}, dt);
        stress.showOn(system);
    }

    MemoryLedger ledger;
    ShapeSystem system;
    ShapeStress stress;
};

TEST(ShapeStress, OfALinearForceIsItsWayInClosedForm) {
    // The voxels are so large that few particles leave theirs.
    Pair pair(400, Force::linear, {0.3f, 0, 0.4f}, 0.2f);
    pair.run([](int) { return Pose(); });
    const float way = 0.5f * dt * dt * steps * (steps + 1) / 2;  // Σ over steps of a·n·dt²
    EXPECT_NEAR(pair.stress.displacements()[0], way, 0.01f * way);
    EXPECT_NEAR(pair.stress.displacements()[1], 0, 1e-4f);
    const float share = way / 0.2f;
    const glm::vec4 shown = pair.system.grid().voxels()[0].colour.colour();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], glm::mix(grey[c], red[c], share), 0.005f);
    EXPECT_NEAR(shown.a, 0.5f, 1e-4f);
    EXPECT_NEAR(pair.system.grid().voxels()[1].colour.colour().r, grey.r, 1e-3f);
}

TEST(ShapeStress, OfPointGravityIsHowFarParticlesHaveFallen) {
    // r = r₀ cos ωt: the mean of |r₀|² over a cube is edge²/4.
    const float edge = 2, omega = 3;
    Pair pair(edge, Force::gravity, {0, omega, 0}, 1);
    pair.run([](int) { return Pose(); });
    const float expected = edge / 2 * (1 - std::cos(omega * dt * steps));
    EXPECT_NEAR(pair.stress.displacements()[0], expected, 0.06f * expected) << "first order, and scatter of 4000";
}

TEST(ShapeStress, OfAShapeAtConstantVelocityIsNoneAndOfAnAcceleratedOneItsLag) {
    const glm::vec3 velocity(2, 0, 1), acceleration(0.8f, 0, 0);
    Pair drifting(4, Force::linear, glm::vec3(0), 0.1f), pushed(4, Force::linear, glm::vec3(0), 0.1f);
    drifting.run([&](int step) {
        Pose pose;
        pose.position = velocity * (dt * static_cast<float>(step));
        pose.velocity = velocity;
        return pose;
    });
    EXPECT_LT(drifting.stress.displacements()[0], 1e-4f);
    pushed.run([&](int step) {
        const float t = dt * static_cast<float>(step);
        Pose pose;
        pose.position = velocity * t + 0.5f * acceleration * t * t;
        pose.velocity = velocity + acceleration * t;
        return pose;
    });
    const float seconds = dt * steps, lag = 0.5f * 0.8f * seconds * seconds;
    EXPECT_NEAR(pushed.stress.displacements()[1], lag, 0.04f * lag) << "a few have left and were replaced by newborns";
}

TEST(ShapeStress, KeepsTheBirthplaceOfAParticleThatTakesAnothersRoom) {
    // The last particles move into the slots of those that die, from one voxel to the other's part of the store.
    Pair pair(0.2f, Force::linear, {-40, 0, 0}, 0.1f);
    for (Voxel& voxel : pair.system.grid().voxels()) voxel.lifetimeSeconds = 0.05f;
    ShapeParticles& particles = pair.system.particles();
    for (int step = 0; step < steps; ++step) pair.system.step({}, {}, dt);
    std::size_t atRest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::vec3 born = particles.birthplace[i], now = particles.store.position(i);
        // The force moves particles out along x; across x they are at rest.
        ASSERT_NEAR(born.y, now.y, 1e-5f) << i;
        ASSERT_NEAR(born.z, now.z, 1e-5f) << i;
        atRest += born == now;
    }
    EXPECT_GE(atRest, 4000u);
}

TEST(ShapeStress, ShowsItsColourWhollyFromItsFullDisplacementOn) {
    Pair pair(400, Force::linear, {0.3f, 0, 0.4f}, 0.01f);
    pair.run([](int) { return Pose(); });
    const glm::vec4 shown = pair.system.grid().voxels()[0].colour.colour();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], red[c], 1e-4f);
}

TEST(ShapeStress, IsReadFromAShapeFile) {
    const TestFolder folder;
    const std::string block = "description = \"\"\n[grid]\ncells = [2, 2, 2]\nedge_metres = 0.25\n";
    const Shape shape = readShape(folder.write("a.toml", block + "[stress]\ncolour = [0, 0, 1]\nfull_metres = 0.3\n"));
    EXPECT_EQ(shape.stress.fullMetres, 0.3f);
    EXPECT_EQ(shape.stress.colour, glm::vec3(0, 0, 1));
    const auto refused = [&](const std::string& more) {
        return inputError([&] { (void)readShape(folder.write("b.toml", block + more)); });
    };
    EXPECT_NE(refused("[stress]\nfull_metres = 0\n").find("full_metres"), std::string::npos);
    EXPECT_NE(refused("[stress]\nfull_meters = 1\n").find("full_metres"), std::string::npos);
    EXPECT_NE(refused("[look]\nlit = true\n[stress]\nfull_metres = 1\n").find("allowed: one"), std::string::npos);
}

}  // namespace
}  // namespace dustbench::voxel_shape
