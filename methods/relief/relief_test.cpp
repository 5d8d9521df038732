// Tests the whole method with dust that flies towards a panel.
#include "methods/relief/relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/meshes/curved_panel.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::relief {
namespace {

constexpr int width = 96, height = 72;
constexpr double dt = 1.0 / 60;

/// A wall of 4 m by 3 m at z = 0 that faces +z.
scene::Scene wallScene(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0, 1);
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = 64;
    relief->rows = 48;
    for (int i = 0; i < 64 * 48; ++i) relief->depth.push_back(any(random));
    relief->colour.assign(relief->depth.size(), glm::vec3(0.1f, 0.5f, 0.1f));
    scene::Panel panel;
    panel.name = "wall";
    panel.sizeMetres = {4, 3};
    panel.depthMetres = 0.1;
    panel.relief = relief;
    scene::Scene scene;
    scene.panels.push_back(panel);
    return scene;
}

/// The same with another wall half a metre behind it.
scene::Scene twoWalls(unsigned seed) {
    scene::Scene scene = wallScene(seed);
    scene.panels.push_back(scene.panels[0]);
    scene.panels[1].name = "behind";
    scene.panels[1].toParent[3].z = -0.5;
    return scene;
}

/// Dust that starts in front of the wall and flies at it, each particle with its own velocity; it continues behind the
/// wall, like the shared dust.
class DustRain {
 public:
    DustRain(int count, unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> any(-1, 1);
        store_.resize(static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < store_.size(); ++i) {
            store_.serial[i] = i;
            store_.x[i] = 3 * any(random), store_.y[i] = 2 * any(random), store_.z[i] = 0.1f + 0.1f * (any(random) + 1);
            store_.velocityX[i] = any(random), store_.velocityY[i] = any(random);
            store_.velocityZ[i] = -2 - any(random);
            store_.age[i] = 1, store_.lifetime[i] = 10, store_.radius[i] = 0.05f, store_.opacity[i] = 0.5f;
        }
    }
    void step() {
        for (std::size_t i = 0; i < store_.size(); ++i) {
            store_.x[i] += store_.velocityX[i] * static_cast<float>(dt);
            store_.y[i] += store_.velocityY[i] * static_cast<float>(dt);
            store_.z[i] += store_.velocityZ[i] * static_cast<float>(dt);
        }
    }
    /// From now on each particle flies back the way it came.
    void turnBack() {
        for (std::size_t i = 0; i < store_.size(); ++i)
            for (auto* velocity : {&store_.velocityX, &store_.velocityY, &store_.velocityZ})
                (*velocity)[i] = -(*velocity)[i];
    }
    /// Particles that went through the wall's face.
    [[nodiscard]] int through() const {
        int count = 0;
        for (std::size_t i = 0; i < store_.size(); ++i) {
            const float t = store_.z[i] / store_.velocityZ[i];
            const float x = store_.x[i] - t * store_.velocityX[i], y = store_.y[i] - t * store_.velocityY[i];
            count += store_.z[i] <= 0 && std::abs(x) <= 2 && std::abs(y) <= 1.5f ? 1 : 0;
        }
        return count;
    }
    /// The same for a curved face: particles that passed from outside to inside on their way of `steps` steps.
    [[nodiscard]] int through(const glm::dvec2& curvature, int steps) const {
        int count = 0;
        for (std::size_t i = 0; i < store_.size(); ++i) {
            const glm::dvec3 now(store_.x[i], store_.y[i], store_.z[i]);
            const glm::dvec3 velocity(store_.velocityX[i], store_.velocityY[i], store_.velocityZ[i]);
            const auto at = [&](int moment) { return now - velocity * (dt * steps * (1 - moment / 4000.0)); };
            const auto outside = [&](const glm::dvec3& place) {
                return place.z > -0.5 * glm::dot(curvature, glm::dvec2(place) * glm::dvec2(place));
            };
            for (int moment = 1; moment <= 4000; ++moment) {
                const glm::dvec3 place = at(moment);
                if (outside(place) || !outside(at(moment - 1))) continue;
                count += std::abs(place.x) <= 2 && std::abs(place.y) <= 1.5 ? 1 : 0;
                break;
            }
        }
        return count;
    }
    [[nodiscard]] Puffs puffs() const { return store_; }

 private:
    MemoryLedger ledger_;
    particles::ParticleStore store_{ledger_};
};

class ReliefTest : public testing::Test {
 protected:
    struct Outcome {
        std::int64_t hits;
        double worn, massError;
        std::uint64_t hash;
        std::int64_t primitives;
        pictures::Image picture;
    };

    Outcome run(const std::map<std::string, std::string>& parameters, int steps = 40, unsigned seed = 1) {
        const MethodInfo info = describe();
        ParameterValues values(info.parameters);
        for (const auto& [name, value] : parameters) values.set(name, value);
        const auto method = info.create(values);
        scene::Scene scene = secondWall_ ? twoWalls(seed) : wallScene(seed);
        scene.panels[0].curvaturePerMetre = curvature_;
        method->prepare(scene, {}, draw::TestCanvas::device());
        draw::TestCanvas canvas(width, height, {0.4, 0.3, 4}, {-0.1, -0.1, -1});
        DustRain rain(800, seed);
        const scene::SceneState state;
        const StageClock untimed;
        const auto frame = [&](int index) { return Frame{index, dt, state, rain.puffs(), canvas.view, untimed}; };
        for (int index = 0; index < steps; ++index) {
            if (turnEvery_ > 0 && index % turnEvery_ == turnEvery_ - 1) rain.turnBack();
            rain.step();
            method->update(frame(index));
        }
        through_ = meshes::isCurved(scene.panels[0]) ? rain.through(curvature_, steps) : rain.through();
        Facts facts(info.facts, FactOver::lastFrame);
        method->report(frame(steps), facts);
        const auto picture = canvas.picture([&](gpu::Layer& layer) { method->draw(frame(steps), layer); });
        return {std::get<std::int64_t>(*facts.value("hits")),
                std::get<double>(*facts.value("worn_share")),
                std::get<double>(*facts.value("mass_error")),
                *method->stateHash(),
                method->primitives(),
                picture};
    }

    int through_ = 0;
    glm::dvec2 curvature_{0};  ///< of the first wall
    int turnEvery_ = 0;        ///< steps after which the dust flies back
    bool secondWall_ = false;  ///< behind the first
};

TEST_F(ReliefTest, EachParticleThatEntersHitsAndNoneTwice) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Outcome outcome = run({{"ageing", "scalar"}, {"scalar", "0"}}, 60, seed);
        EXPECT_GT(through_, 200);
        // Particles within centimetres of the rim may leave by it.
        EXPECT_LE(outcome.hits, through_);
        EXPECT_GE(outcome.hits, through_ * 97 / 100);
        EXPECT_EQ(outcome.primitives, 800 - through_);  // particles inside the relief are not drawn behind the wall
    }
}

TEST_F(ReliefTest, ACurvedWallIsHitByWhatFliesThroughItsFace) {
    for (const glm::dvec2& curvature : {glm::dvec2(0.5, 0), {-0.05, 0}, {0.3, 0.4}}) {
        curvature_ = curvature;
        const Outcome outcome = run({{"ageing", "scalar"}, {"scalar", "0"}}, 90);
        EXPECT_GT(through_, 100) << curvature.x;
        EXPECT_NEAR(static_cast<double>(800 - outcome.primitives), through_, 2) << curvature.x;
        EXPECT_LE(outcome.hits, through_ + 2);
        EXPECT_GE(outcome.hits, through_ * 95 / 100) << curvature.x;
    }
    const Outcome worn = run({{"ageing", "crater"}}, 90);
    EXPECT_GT(worn.worn, 0);
    EXPECT_LT(worn.massError, 1e-6);
}

TEST_F(ReliefTest, ACurvedWallKeepsItsParticlesInColumns) {
    curvature_ = {0.5, 0};
    EXPECT_THROW(run({{"state", "texture"}}, 1), InputError);
}

// The shared dust ignores reliefs: it may fly back through the face, or reach a second wall. Particles taken by a
// relief are no longer drawn outside, which shows how many it took.
TEST_F(ReliefTest, AParticleIsTakenOnceHoweverOftenItPassesAFace) {
    turnEvery_ = 15;
    for (const unsigned seed : {1u, 2u}) {
        const Outcome outcome = run({{"ageing", "scalar"}, {"scalar", "0"}}, 60, seed);
        EXPECT_GT(outcome.hits, 200);
        EXPECT_LE(outcome.hits, 800 - outcome.primitives);
    }
}

TEST_F(ReliefTest, WhatTheFirstWallTookDoesNotReachTheSecond) {
    secondWall_ = true;
    const Outcome outcome = run({{"ageing", "scalar"}, {"scalar", "0"}}, 60);
    EXPECT_GT(outcome.hits, 200);
    EXPECT_LE(outcome.hits, 800 - outcome.primitives);
}

TEST_F(ReliefTest, HitsWearTheWallAndKeepTheMass) {
    for (const char* model : {"paper", "scalar", "crater"}) {
        const Outcome outcome = run({{"ageing", model}});
        EXPECT_GT(outcome.worn, 0) << model;
        EXPECT_LT(outcome.massError, 1e-6) << model;
    }
    const Outcome laid = run({{"ageing", "deposit"}});
    EXPECT_EQ(laid.worn, 0);
    EXPECT_GT(laid.hits, 0);
    EXPECT_LT(laid.massError, 1e-6);
}

TEST_F(ReliefTest, GatherAndScatterEndInTheSameState) {
    for (const char* model : {"paper", "crater", "deposit"})
        EXPECT_EQ(run({{"ageing", model}, {"search", "gather"}}, 12).hash,
                  run({{"ageing", model}, {"search", "scatter"}}, 12).hash)
            << model;
    EXPECT_NE(run({{"ageing", "crater"}}, 12).hash, run({{"ageing", "deposit"}}, 12).hash);
}

TEST_F(ReliefTest, StateInTexturesWearsTheWallInTheSameWay) {
    for (const char* law : {"paper", "fixed"})
        for (const unsigned seed : {1u, 2u}) {
            const Outcome array = run({{"motion", law}, {"ageing", "scalar"}}, 40, seed);
            const Outcome texture = run({{"motion", law}, {"ageing", "scalar"}, {"state", "texture"}}, 40, seed);
            EXPECT_GT(array.hits, 0);
            EXPECT_EQ(array.hits, texture.hits) << law << ' ' << seed;
            EXPECT_NEAR(array.worn, texture.worn, 1e-9);
        }
}

TEST_F(ReliefTest, WornAndFreshWallsLookDifferent) {
    const Outcome fresh = run({{"ageing", "scalar"}, {"scalar", "0"}}), worn = run({{"ageing", "paper"}});
    int different = 0, opaque = 0;
    for (std::size_t i = 0; i < fresh.picture.pixels.size(); ++i) {
        opaque += worn.picture.pixels[i].a == 1.0f ? 1 : 0;
        different += glm::distance(glm::vec3(fresh.picture.pixels[i]), glm::vec3(worn.picture.pixels[i])) > 0.1f;
    }
    EXPECT_GT(opaque, width * height / 3);
    EXPECT_GT(different, 50);
}

TEST(ReliefMethod, NeedsAPanel) {
    const MethodInfo info = describe();
    EXPECT_TRUE(info.drawsPanels);
    EXPECT_NE(info.cannotTake(scene::Scene{}), "");
    EXPECT_EQ(info.cannotTake(wallScene(1)), "");
}

}  // namespace
}  // namespace dustbench::relief
