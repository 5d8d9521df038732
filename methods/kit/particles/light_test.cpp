// Compares light on particles and light from particles with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "methods/kit/particles/shading_part.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

/// Particles on a line along x at y = 1, of one colour, at rest.
ParticleSystem lit(const std::string& shadings, std::uint64_t seed = 1) {
    auto system = test::systemFrom(
        "emission = { part = \"stream\", rate_per_second = 1000, rate_per_metre = 0 }\n"
        "position = { part = \"line\", at = \"place\", place = [-5, 1, 0], direction = [1, 0, 0], length_metres = 10 "
        "}\n"
        "velocity = { part = \"fixed\", speed = 0 }\n"
        "colour = { part = \"linear\", start = [0.5, 0.25, 1], end = [0.5, 0.25, 1] }\n"
        "size = { part = \"random\", average_metres = 0.5, variation_metres = 0.25 }\n"
        "life = [ { part = \"lifetime\", average_seconds = 3, variation_seconds = 1 } ]\nshading = [ " +
            shadings + " ]\n",
        seed);
    scene::Scene scene;
    scene.lights.ambient = {0.1f, 0.2f, 0.3f};
    for (int i = 0; i < 60; ++i) {
        const scene::SceneState state;
        system.update({scene, state, 1.0 / 60});
    }
    return system;
}

TEST(Shading, AmbientLightMultipliesTheColourAndLightsAdd) {
    const auto one = lit("{ part = \"ambient\", colour = [0.5, 1, 2] }");
    const auto two = lit("{ part = \"ambient\", colour = [0.5, 1, 2] }, { part = \"ambient\", from = \"scene\" }");
    ASSERT_GT(one.store().size(), 900u);
    for (std::size_t i = 0; i < one.store().size(); ++i) {
        EXPECT_NEAR(one.store().red[i], 0.5 * 0.5, 1e-6);
        EXPECT_NEAR(one.store().green[i], 0.25 * 1, 1e-6);
        EXPECT_NEAR(one.store().blue[i], 1 * 2, 1e-6);
        EXPECT_NEAR(two.store().red[i], 0.5 * 0.6, 1e-6);
        EXPECT_NEAR(two.store().blue[i], 1 * 2.3, 1e-6);
    }
}

TEST(Shading, LightFallsWithTheSquareOfTheDistanceUpToItsMaximum) {
    const auto system =
        lit("{ part = \"light\", place = [1, 1, 0], colour = [1, 0.5, 0], intensity = 2, maximum = 0.8 }");
    int limited = 0;
    for (std::size_t i = 0; i < system.store().size(); ++i) {
        const double d = static_cast<double>(system.store().x[i]) - 1;
        const double luminosity = std::min(2 / (d * d), 0.8);
        EXPECT_NEAR(system.store().red[i], 0.5 * luminosity, 1e-5);
        EXPECT_NEAR(system.store().green[i], 0.25 * 0.5 * luminosity, 1e-5);
        EXPECT_EQ(system.store().blue[i], 0);
        limited += luminosity < 0.8 ? 0 : 1;
    }
    EXPECT_GT(limited, 100);
}

TEST(Shading, LightFallsWithTheCubeOfTheDistanceWhereThatIsChosen) {
    const auto system = lit(
        "{ part = \"light\", place = [1, 1, 0], colour = [1, 0.5, 0], intensity = 2, maximum = 0.8, falloff = \"1/d3\" "
        "}");
    int limited = 0;
    for (std::size_t i = 0; i < system.store().size(); ++i) {
        const double d = std::abs(static_cast<double>(system.store().x[i]) - 1);
        const double luminosity = std::min(2 / (d * d * d), 0.8);
        EXPECT_NEAR(system.store().red[i], 0.5 * luminosity, 1e-5);
        limited += luminosity < 0.8 ? 0 : 1;
    }
    EXPECT_GT(limited, 100);
}

TEST(EmittedLight, IsTheThesissSumAndItsPlaceTheBarycentre) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto system = lit("{ part = \"light\", place = [1, 1, 0], colour = [1, 0.5, 0.2], intensity = 2 }", seed);
        const ParticleStore& s = system.store();
        for (const int parts : {1, 3}) {
            const auto lights = emittedLights(s, parts, 0.7f);
            ASSERT_EQ(lights.size(), static_cast<std::size_t>(parts));
            for (int part = 0; part < parts; ++part) {
                double red = 0, place = 0, luminosity = 0;
                for (std::size_t i = 0; i < s.size(); ++i) {
                    const double share = static_cast<double>(s.age[i]) / static_cast<double>(s.lifetime[i]);
                    if (static_cast<int>(share * parts) != part) continue;
                    const double volume = std::pow(static_cast<double>(s.radius[i]), 3),
                                 weight = static_cast<double>(s.opacity[i]) * volume;
                    red += 0.7 * static_cast<double>(s.red[i]) * weight;
                    const double l = static_cast<double>(s.red[i] + s.green[i] + s.blue[i]) * weight;
                    place += l * static_cast<double>(s.x[i]);
                    luminosity += l;
                }
                const EmittedLight& light = lights[static_cast<std::size_t>(part)];
                EXPECT_NEAR(light.colour.r, red, 1e-5 * red);
                EXPECT_NEAR(light.position.x, luminosity > 0 ? place / luminosity : 0, 1e-5);
                if (luminosity > 0) {
                    EXPECT_NEAR(light.position.y, 1, 1e-6);
                }
            }
        }
    }
}

TEST(EmittedLight, PartsTogetherGiveAsMuchAsOne) {
    const auto system = lit("{ part = \"ambient\", colour = [1, 1, 1] }");
    const glm::vec3 whole = emittedLights(system.store(), 1, 1)[0].colour;
    glm::vec3 sum(0);
    for (const EmittedLight& light : emittedLights(system.store(), 5, 1)) sum += light.colour;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], whole[k], 1e-5f * whole[k]);
    EXPECT_THROW((void)emittedLights(system.store(), 0, 1), std::invalid_argument);
    EXPECT_EQ(emittedLights(Puffs{}, 2, 1)[1].colour, glm::vec3(0));
}

TEST(EmittedLight, GroupsByPlaceAndByLuminosityAreTheThesissSums) {
    // Two heaps: 3 dim particles near x = −4, 2 bright ones near x = 4; the box is longest along x.
    const std::vector<float> x{-4, -4.5f, -3.5f, 4, 4.5f}, y{0, 1, 2, 0, 1}, z(5, 0), zero(5, 0), one(5, 1);
    const std::vector<float> radius{1, 1, 1, 2, 2}, opacity(5, 0.5f);
    const std::vector<std::uint64_t> serial{0, 1, 2, 3, 4};
    Puffs puffs;
    puffs.serial = serial, puffs.x = x, puffs.y = y, puffs.z = z;
    puffs.velocityX = puffs.velocityY = puffs.velocityZ = zero;
    puffs.age = zero, puffs.lifetime = one, puffs.radius = radius, puffs.opacity = opacity;
    puffs.uniformColour = true, puffs.colourOfAll = {1, 0.5f, 0.5f};
    for (const GlowBy by : {GlowBy::place, GlowBy::luminosity}) {
        const auto lights = emittedLights(puffs, 2, 1, by);
        EXPECT_EQ(lights[0].colour, glm::vec3(1.5f, 0.75f, 0.75f));
        EXPECT_EQ(lights[0].position, glm::vec3(-4, 1, 0));
        EXPECT_EQ(lights[1].colour, glm::vec3(8, 4, 4));
        EXPECT_EQ(lights[1].position, glm::vec3(4.25f, 0.5f, 0));
    }
    EXPECT_EQ(emittedLights(puffs, 2, 1)[1].colour, glm::vec3(0));  // all are young
    EXPECT_EQ(emittedLights(puffs, 4, 1, GlowBy::place)[1].colour, glm::vec3(0));
    EXPECT_EQ(emittedLights(Puffs{}, 2, 1, GlowBy::place)[1].colour, glm::vec3(0));
}

}  // namespace
}  // namespace dustbench::particles
