// Compares the shader's particles with those of the CPU.
#include "methods/relief/particles_gl/texture_mover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include "methods/kit/draw/test_canvas.h"

namespace dustbench::relief {
namespace {

scene::Panel randomPanel(unsigned seed) {
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = 40;
    relief->rows = 31;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0.1f, 1);
    for (int i = 0; i < 40 * 31; ++i) relief->depth.push_back(any(random));
    scene::Panel panel;
    panel.sizeMetres = {1.2, 0.9};
    panel.depthMetres = 0.3;
    panel.relief = relief;
    return panel;
}

class TextureMoverTest : public testing::TestWithParam<std::tuple<MotionLaw, unsigned>> {
 protected:
    TextureMoverTest() : panel_(randomPanel(std::get<1>(GetParam()))), surface_(*panel_.relief, ledger_) {}

    void addSome(int count) {
        std::uniform_real_distribution<float> any(-1, 1);
        for (int n = 0; n < count; ++n) {
            const float speed = std::pow(10.0f, 1.5f * any(random_));
            const Motion motion{{0.6f * any(random_), 0.45f * any(random_), 0},
                                {speed * any(random_), speed * any(random_), -speed}};
            arrays_.add(motion, {}, born_);
            textures_.add(motion, {}, born_++);
        }
    }

    MemoryLedger ledger_;
    scene::Panel panel_;
    WornSurface surface_;
    ReliefParticles arrays_{panel_, ledger_}, textures_{panel_, ledger_};
    std::mt19937 random_{std::get<1>(GetParam())};
    std::uint64_t born_ = 0;
};

/// The textures hold the living particles, those that hit in this step, and nothing of the step before.
void expectStateHolds(const TextureMover& mover, const ReliefParticles& particles) {
    const TextureMover::StateCopy state = mover.copyState();
    ASSERT_EQ(mover.living().size(), particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const auto texel = static_cast<std::size_t>(mover.living()[i]);
        ASSERT_EQ(state.places[texel], particles.places()[i]);
        ASSERT_EQ(glm::vec3(state.velocities[texel]), glm::vec3(particles.velocities()[i]));
    }
    const auto of = [&](Fate fate) {
        return static_cast<std::size_t>(std::ranges::count_if(state.velocities, [&](const glm::vec4& v) {
            return v != glm::vec4(0) && v.w == static_cast<float>(fate);
        }));
    };
    EXPECT_EQ(of(Fate::hit), particles.hits().size());
    EXPECT_EQ(of(Fate::lives), particles.size());
}

// Births in each step, ends of all kinds, growth past one row of texels, and a surface that wears meanwhile.
TEST_P(TextureMoverTest, EndsWhereTheOracleDoes) {
    TextureMover mover(draw::TestCanvas::device(), panel_, surface_.depths());
    StepSettings settings;
    settings.law = std::get<0>(GetParam());
    settings.gravity = {0.3f, -9.8f, -1};
    settings.maximumAgeSteps = 12;
    std::size_t hits = 0, most = 0;
    for (int step = 0; step < 30; ++step) {
        addSome(step < 15 ? 800 : 0);
        arrays_.step(surface_.depths(), settings);
        textures_.step(mover, surface_.depths(), settings);
        ASSERT_EQ(arrays_.size(), textures_.size()) << step;
        ASSERT_EQ(arrays_.hits().size(), textures_.hits().size()) << step;
        for (std::size_t i = 0; i < arrays_.size(); ++i) {
            const glm::vec4 a = arrays_.places()[i], b = textures_.places()[i];
            // An ulp of the summands: compilers may keep a fused product.
            ASSERT_LE(glm::distance(a, b), 3e-7f * (1 + glm::length(a))) << step << ' ' << i;
            ASSERT_LE(glm::distance(arrays_.velocities()[i], textures_.velocities()[i]),
                      3e-7f * (1 + glm::length(arrays_.velocities()[i])));
        }
        expectStateHolds(mover, textures_);
        std::vector<Impact> impacts;
        for (std::size_t i = 0; i < arrays_.hits().size(); ++i) {
            const SurfaceHit &a = arrays_.hits()[i], &b = textures_.hits()[i];
            ASSERT_EQ(a.serial, b.serial);
            ASSERT_LE(glm::distance(a.texels, b.texels), 1e-4f);  // in texels, of a place in float metres
            impacts.push_back({a.texels.x, a.texels.y, 2, DepthMap::bottom / 50});
        }
        hits += impacts.size();
        most = std::max(most, arrays_.size());
        surface_.scatter(impacts);
        surface_.takeOff();
        mover.upload(surface_.depths(), surface_.takeChanged());
    }
    EXPECT_GT(hits, 2000u);
    EXPECT_GT(most, 1024u);
    EXPECT_EQ(arrays_.size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(LawsAndSeeds, TextureMoverTest,
                         testing::Combine(testing::Values(MotionLaw::fixed, MotionLaw::paper),
                                          testing::Values(1u, 2u, 3u)));

}  // namespace
}  // namespace dustbench::relief
