#include "methods/plugin_particles/sunlight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/plugin_particles/plugin_particles.h"

namespace dustbench::plugin_particles {
namespace {

constexpr float radiusMetres = 0.5f, opacityOfOne = 0.9f;
constexpr double eyeMetres = 40;

particles::ParticleStore onePuff(MemoryLedger& ledger, const glm::vec3& place) {
    particles::ParticleStore store(ledger);
    store.resize(1);
    store.x[0] = place.x, store.y[0] = place.y, store.z[0] = place.z;
    store.radius[0] = radiusMetres;
    store.opacity[0] = opacityOfOne;
    store.colourOfAll = {0.5f, 0.25f, 1};
    return store;
}

TEST(Sunlight, IsWhatThePuffsOfAllSystemsLetThrough) {
    scene::Scene scene;
    scene.lights.onDust = true;
    const glm::vec3 toSun = scene.lights.toSun;
    MemoryLedger ledger;
    const auto front = onePuff(ledger, glm::vec3(0)), behind = onePuff(ledger, -0.6f * toSun),
               aside = onePuff(ledger, {50, 0, 0});
    Sunlight sun(scene);
    sun.shine(std::vector<Puffs>{front, behind, aside});
    EXPECT_EQ(sun.casting().size(), 3u);

    const double depth = maths::puffOpticalDepth(static_cast<double>(opacityOfOne));
    const auto passed = [&](double metres) {  // half of its own depth, and the part of the other's
        const double s = maths::puffDeviationMetres(static_cast<double>(radiusMetres));
        return std::exp(-depth * (0.5 + 0.5 * (1 + std::erf(metres / (std::sqrt(2.0) * s)))));
    };
    const glm::dvec3 eye(0, 0, eyeMetres);
    const auto expected = [&](const particles::ParticleStore& store, double transmittance) {
        const glm::dvec3 sight = glm::normalize(glm::dvec3(store.position(0)) - eye);
        const auto cosine = static_cast<float>(glm::dot(sight, glm::dvec3(toSun)));
        return store.colourOfAll * scene::dustLight(scene, static_cast<float>(transmittance), cosine);
    };
    light::LitPuffs colours;
    for (const auto& [store, transmittance] :
         {std::pair(&front, passed(-0.6)), {&behind, passed(0.6)}, {&aside, std::exp(-depth / 2)}}) {
        const glm::vec3 seen = sun.on(*store, eye, colours).colour(0), right = expected(*store, transmittance);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], right[c], 1e-3f) << transmittance;
    }
    sun.shine({});
    EXPECT_TRUE(sun.casting().empty());
    const glm::vec3 alone = sun.on(behind, eye, colours).colour(0), unshaded = expected(behind, 1);
    EXPECT_NEAR(alone.g, unshaded.g, 1e-6f);
}

std::string cloud(const std::string& name, const std::string& render) {
    return "[[system]]\nname = \"" + name + R"("
emission = { part = "bursts", count = 200, duration_seconds = 0, interval_seconds = 100 }
position = { part = "sphere", at = "place", place = [0, 1.5, -8], radius_metres = 1 }
velocity = { part = "fixed", speed = 0 }
colour = { part = "constant", colour = [0.6, 0.5, 0.4], from = "own" }
size = { part = "constant", radius_metres = 0.3 }
life = [ { part = "lifetime", average_seconds = 100, variation_seconds = 0 } ]
render = { )" +
           render + " }\n";
}

class Lit : public TestMoment {
 public:
    explicit Lit(bool sun) : TestMoment(0, 160, 120, {0, 1, 0}, {0, 0, -1}) { scene.lights.onDust = sun; }

    PluginParticles& make(const std::string& toml) {
        method.emplace(particles::systemsFromText(toml, "test.toml"));
        method->prepare(scene, {}, device());
        picture = updateAndDraw(*method);
        return *method;
    }
    std::optional<PluginParticles> method;
    pictures::Image picture;
};

double brightness(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
    return sum;
}

double alphaOf(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.a);
    return sum;
}

TEST(Sunlight, ShadesWhatScattersAndLeavesWhatShines) {
    for (const char* const primitive : {"puff", "points", "sprites", "lines"}) {
        const std::string alpha = std::string("part = \"") + primitive + "\", blend = \"alpha\"";
        const std::string additive = std::string("part = \"") + primitive + "\", blend = \"additive\"";
        Lit with(true), without(false);
        const bool hasSize = std::string_view(primitive) == "puff" || std::string_view(primitive) == "sprites";
        EXPECT_EQ(with.make(cloud("a", alpha)).shadowing().size(), hasSize ? 200u : 0u) << primitive;
        EXPECT_EQ(without.make(cloud("a", alpha)).shadowing().size(), 0u);
        EXPECT_EQ(with.method->stateHash(), without.method->stateHash());
        EXPECT_NEAR(alphaOf(with.picture), alphaOf(without.picture), 1e-4 * alphaOf(without.picture)) << primitive;
        if (alphaOf(without.picture) > 0) {
            EXPECT_GT(std::abs(brightness(with.picture) / brightness(without.picture) - 1), 0.05) << primitive;
        }

        Lit bright(true), plain(false);
        EXPECT_TRUE(bright.make(cloud("a", additive)).shadowing().empty());
        plain.make(cloud("a", additive));
        EXPECT_EQ(bright.picture.pixels, plain.picture.pixels) << primitive;
    }
}

TEST(Sunlight, FallsOnOneSystemThroughAnother) {
    const std::string puff = "part = \"puff\"", shining = "part = \"puff\", blend = \"additive\"";
    std::string shade = cloud("shade", puff);
    const glm::vec3 place = glm::vec3(0, 1.5f, -8) + 4.0f * scene::Lights().toSun;
    const std::string at =
        "[" + std::to_string(place.x) + ", " + std::to_string(place.y) + ", " + std::to_string(place.z) + "]";
    shade.replace(shade.find("[0, 1.5, -8]"), 12, at);
    std::string glare = shade;
    glare.replace(glare.find(puff), puff.size(), shining);
    // The colours of the first system: beyond the second one it is darker; light that particles emit casts no shadow.
    const auto seen = [&](const std::string& toml) {
        class First final : public VolumeVisitor {
         public:
            void puffs(const Puffs& puffs) override {
                if (sum == 0)
                    for (std::size_t i = 0; i < puffs.size(); ++i) sum += static_cast<double>(puffs.colour(i).g);
            }
            void octree(const OctreeVolume&) override {}
            void grid(const GridVolume&) override {}
            double sum = 0;
        };
        Lit moment(true);
        First first;
        moment.make(toml).volume(moment.frame(), first);
        return first.sum;
    };
    const double alone = seen(cloud("a", puff)), shaded = seen(cloud("a", puff) + shade);
    EXPECT_LT(shaded, 0.97 * alone);
    EXPECT_EQ(seen(cloud("a", puff) + glare), alone);
}

}  // namespace
}  // namespace dustbench::plugin_particles
