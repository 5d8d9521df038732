#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

/// Columns for one chunk of particles with random positions and velocities.
struct Bunch {
    explicit Bunch(std::size_t count) : values(8, std::vector<float>(count)) {
        chunk.count = count;
        std::size_t next = 0;
        for (float** column : {&chunk.x, &chunk.y, &chunk.z, &chunk.velocityX, &chunk.velocityY, &chunk.velocityZ,
                               &chunk.radius, &chunk.opacity})
            *column = values[next++].data();
        for (std::size_t i = 0; i < count; ++i) {
            const auto a = maths::uniform4(1, 1, i), b = maths::uniform4(1, 2, i);
            chunk.x[i] = 60 * maths::centred(a[0]);
            chunk.y[i] = 3 * maths::centred(a[1]);
            chunk.z[i] = 60 * maths::centred(a[2]);
            chunk.velocityX[i] = 5 * maths::centred(b[0]);
            chunk.velocityY[i] = 5 * maths::centred(b[1]);
            chunk.velocityZ[i] = 5 * maths::centred(b[2]);
            chunk.radius[i] = a[3];
        }
    }
    [[nodiscard]] glm::vec3 velocity(std::size_t i) const {
        return {chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]};
    }

    std::vector<std::vector<float>> values;
    Chunk chunk;
};

scene::Scene hills() {
    scene::Scene scene;
    std::vector<float> heights(40 * 30);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = 2 * maths::uniform4(3, 1, i)[0];
    scene.terrain = scene::Terrain(std::move(heights), 40, 30, 2.5f, -50, -37);
    return scene;
}

class GroundOn : public testing::TestWithParam<bool> {};

TEST_P(GroundOn, LeavesNobodyBelowAndTakesWhatGoesInto) {
    const scene::Scene scene = GetParam() ? hills() : scene::Scene{};
    const scene::SceneState state;
    const auto ground =
        makePartOf<ForcePart>(PartKind::force, "ground", {{"lift", "0.3"}, {"friction_per_second", "6"}});
    const Step step{scene, state, 0.5, 1, 0, {}};
    const float kept = 1 / (1 + 6 * 0.5f);
    for (const std::size_t count : {1ul, 7ul, 500ul, 512ul}) {
        const Bunch before(count);
        Bunch after(count);
        ground->touch(after.chunk, step);
        std::size_t touched = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const float x = before.chunk.x[i], z = before.chunk.z[i], y = before.chunk.y[i];
            // Exactly the terrain's own height, not only close to it.
            const float floor = scene.terrain.heightAt(x, z) + 0.3f * before.chunk.radius[i];
            const glm::vec3 v = before.velocity(i);
            if (y < floor) {
                ++touched;
                const glm::vec3 normal = scene.terrain.normalAt(x, z);
                const glm::vec3 expected = kept * (v - std::min(glm::dot(v, normal), 0.0f) * normal);
                EXPECT_EQ(after.chunk.y[i], floor);
                EXPECT_LT(glm::length(after.velocity(i) - expected), 1e-5f);
                EXPECT_GE(glm::dot(after.velocity(i), normal), -1e-5f);
            } else {
                EXPECT_EQ(after.chunk.y[i], y);
                EXPECT_EQ(after.velocity(i), v);
            }
            EXPECT_EQ(after.chunk.x[i], x);
            EXPECT_EQ(after.chunk.z[i], z);
        }
        if (count > 100) {
            EXPECT_GT(touched, count / 4);
            EXPECT_LT(touched, count);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(FlatAndHills, GroundOn, testing::Bool());

TEST(Ground, LevelHeightFieldDoesAsThePlaneDoes) {
    scene::Scene level;
    level.terrain = scene::Terrain(std::vector<float>(100 * 100, 0.0f), 100, 100, 2, -100, -100);
    const scene::Scene plane;
    const scene::SceneState state;
    const auto ground = makePartOf<ForcePart>(PartKind::force, "ground");
    Bunch onLevel(512), onPlane(512);
    ground->touch(onLevel.chunk, {level, state, 0.1, 1, 0, {}});
    ground->touch(onPlane.chunk, {plane, state, 0.1, 1, 0, {}});
    EXPECT_EQ(onLevel.values, onPlane.values);
}

TEST(Ground, NobodyIsBelowItAfterAnyUpdate) {
    scene::Scene scene = hills();
    scene.vehicle.emplace();
    auto system = test::systemFrom(test::everyForce);
    for (int i = 1; i <= 200; ++i) {
        scene::SceneState state = test::drivingStraight(i / 60.0, 10);
        for (auto& wheel : state.vehicle.wheels)
            wheel.contact.y =
                scene.terrain.heightAt(static_cast<float>(wheel.contact.x), static_cast<float>(wheel.contact.z));
        system.update({scene, state, 1.0 / 60, 0});
        const ParticleStore& store = system.store();
        for (std::size_t k = 0; k < store.size(); ++k)
            ASSERT_GE(store.y[k], scene.terrain.heightAt(store.x[k], store.z[k]) + 0.3f * store.radius[k]);
    }
}

}  // namespace
}  // namespace dustbench::particles
