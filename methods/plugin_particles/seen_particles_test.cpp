#include "methods/plugin_particles/seen_particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/plugin_particles/detail_experiment.h"
#include "methods/plugin_particles/plugin_particles.h"

namespace dustbench::plugin_particles {
namespace {

/// Particles on all sides of the eye, near and far, some so near that their quads reach into the picture from outside.
std::string around(const std::string& render) {
    return R"([[system]]
name = "around"
emission = { part = "bursts", count = 3000, duration_seconds = 0, interval_seconds = 100 }
position = { part = "sphere", at = "place", place = [0, 1, 0], radius_metres = 12 }
velocity = { part = "random", speed = 30, variation = 20 }
colour = { part = "constant", colour = [0.6, 0.5, 0.4], from = "own" }
size = { part = "random", average_metres = 0.4, variation_metres = 0.39 }
life = [ { part = "lifetime", average_seconds = 100, variation_seconds = 0 } ]
render = { )" +
           render + " }\n";
}

class Watched : public TestMoment {
 public:
    Watched(const std::string& toml, const Sight& sight, bool sun = false)
        : TestMoment(0, 160, 120, {0, 1, 0}, {0.2, -0.1, -1}),
          method(particles::systemsFromText(toml, "test.toml"), {}, sight) {
        scene.lights.onDust = sun;
        method.prepare(scene, {}, device());
        for (int step = 0; step < 3; ++step) method.update(frame());
    }
    PluginParticles method;
};

/// Mesa 25 draws meshes with last bits that differ from run to run, by up to 1e-8; all other primitives are equal.
void expectSame(const pictures::Image& seen, const pictures::Image& expected, std::string_view render) {
    const float allowed = render == "part = \"objects\"" ? 1e-7f : 0.0f;
    float most = 0;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
        most = std::max(most, glm::distance(seen.pixels[i], expected.pixels[i]));
    EXPECT_LE(most, allowed) << render;
}

TEST(SeenParticles, CullingLeavesThePictureAsItIs) {
    for (const char* const render :
         {"part = \"puff\"", "part = \"sprites\", blend = \"additive\"", "part = \"points\", pixels = 9",
          "part = \"points\", pixels = 0, blend = \"alpha\"", "part = \"lines\", seconds = 0.05", "part = \"curves\"",
          "part = \"hybrid\", pixels = 5", "part = \"aa_sprites\", seconds = 0.04", "part = \"objects\"",
          "part = \"puff\", stereo = true, eyes_metres = 0.5"}) {
        Watched all(around(render), {}), culled(around(render), {true, 0});
        const pictures::Image expected = all.draw(all.method), seen = culled.draw(culled.method);
        expectSame(seen, expected, render);
        EXPECT_GT(std::ranges::count_if(expected.pixels, [](const glm::vec4& p) { return p.r > 0; }), 50) << render;
        EXPECT_EQ(culled.method.stateHash(), all.method.stateHash()) << render;
        if (std::string_view(render) != "part = \"curves\"") {
            EXPECT_LT(culled.method.primitives(), all.method.primitives() / 3) << render;
        }
        // Another view of the same state, as in a paused window.
        for (Watched* each : {&all, &culled})
            each->view.camera.target = each->view.camera.eye + glm::dvec3(1, 0.1, 0.4);
        expectSame(culled.draw(culled.method), all.draw(all.method), render);
    }
    Watched all(around("part = \"puff\""), {}, true), culled(around("part = \"puff\""), {true, 0}, true);
    EXPECT_EQ(culled.draw(culled.method).pixels, all.draw(all.method).pixels) << "in sunlight";
    EXPECT_EQ(culled.method.shadowing().size(), 3000u) << "particles out of sight cast shadows";
}

TEST(SeenParticles, ThinningKeepsTheMeanMassAndIsContinuous) {
    for (const float share : {0.05f, 0.3f, 0.7f, 0.95f, 0.999f}) {
        double sum = 0, kept = 0;
        constexpr std::uint64_t count = 1 << 16;
        for (std::uint64_t serial = 0; serial < count; ++serial) {
            const Thinned as = thinned(serial, 4 * share, 4);
            EXPECT_NEAR(as.growth * share, 1, 1e-5);
            sum += static_cast<double>(as.weight * as.growth * as.growth);
            kept += as.weight > 0 ? 1 : 0;
        }
        EXPECT_NEAR(sum / count, 1, 2e-3) << share;
        const double f = static_cast<double>(share) * static_cast<double>(share);
        EXPECT_NEAR(kept / count, 8 * f / (7 + f), 2e-3) << share;
    }
    for (const float pixels : {4.0f, 4.1f, 1000.0f}) EXPECT_EQ(thinned(7, pixels, 4).weight, 1) << pixels;
    EXPECT_EQ(thinned(7, 4.1f, 4).growth, 1);
    // A particle that moves away keeps its size on the screen and fades.
    for (std::uint64_t serial = 0; serial < 50; ++serial) {
        float before = thinned(serial, 3.8f, 4).weight;
        for (float pixels = 3.8f; pixels > 0.05f; pixels *= 0.9999f) {
            const float now = thinned(serial, pixels, 4).weight;
            EXPECT_NEAR(now, before, 0.02f) << serial << ' ' << pixels;
            EXPECT_LE(now, before + 1e-4f);
            before = now;
        }
    }
}

TEST(SeenParticles, ThinnedCloudHasTheMassOfAll) {
    MemoryLedger ledger;
    particles::ParticleStore store(ledger);
    store.resize(20'000);
    for (std::size_t i = 0; i < store.size(); ++i) {
        const auto u = maths::uniform4(3, 1, i);
        store.serial[i] = i;
        store.x[i] = 40 * (u[0] - 0.5f), store.y[i] = 40 * (u[1] - 0.5f), store.z[i] = -80 - 40 * u[2];
        store.radius[i] = 0.3f, store.opacity[i] = 0.2f + 0.6f * u[3], store.age[i] = 1, store.lifetime[i] = 2;
    }
    scene::View view;
    view.camera.eye = glm::dvec3(0);
    view.camera.target = {0, 0, -1};
    view.height = 480;
    const auto massOf = [](const Puffs& p) {
        double sum = 0;
        for (std::size_t i = 0; i < p.size(); ++i)
            sum += maths::puffMassSquareMetres(static_cast<double>(p.opacity[i]), static_cast<double>(p.radius[i]));
        return sum;
    };
    SeenParticles seen;
    for (const float detail : {2.0f, 4.0f, 8.0f}) {
        const Puffs thin = seen.of(store, view, {}, 1.0f / 60, {false, detail});
        EXPECT_LT(thin.size(), store.size() * 3 / 4) << detail;
        // Three deviations of the mean of optical depths, which vary by 70 %.
        EXPECT_NEAR(massOf(thin) / massOf(store), 1, 2.1 / std::sqrt(static_cast<double>(thin.size()))) << detail;
    }
    EXPECT_EQ(seen.of(store, view, {}, 1.0f / 60, {false, 0}).size(), store.size());
    particles::Look lines;
    lines.primitive = particles::Primitive::lines;
    EXPECT_EQ(seen.of(store, view, lines, 1.0f / 60, {false, 8}).size(), store.size()) << "lines have no size";
}

TEST(Detail, SavesAndErrsAsItSays) {
    std::map<std::string, Finding> found;
    const bool fullSize = std::getenv("DUSTBENCH_FULL_SIZE") != nullptr;
    for (const Finding& each :
         detail::measureDetail(TestMoment::device(), 1, fullSize ? 60'000 : 8000, fullSize ? 15 : 1)) {
        found[each.quantity] = each;
        RecordProperty(each.quantity, std::to_string(each.value));
    }
    EXPECT_EQ(found["culled_difference"].value, 0);
    EXPECT_LT(found["culled_share"].value, 0.4);
    double before = 0;
    for (const std::string detail : {"detail_1", "detail_2", "detail_4", "detail_8"}) {
        EXPECT_LT(found[detail + "_share"].value, 0.95) << detail;
        EXPECT_GT(found[detail + "_rms"].value, before) << detail;
        before = found[detail + "_rms"].value;
        // Larger quads cover each other more, so that alpha, which is not linear in the mass, decreases.
        EXPECT_LT(found[detail + "_depth"].value, 1.1) << detail;
        EXPECT_GT(found[detail + "_depth"].value, detail == "detail_8" ? 0.75 : 0.9) << detail;
    }
}

}  // namespace
}  // namespace dustbench::plugin_particles
