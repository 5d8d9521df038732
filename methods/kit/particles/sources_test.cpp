// Tests the distributions of sources, start velocities and bursts.
//
// The level of all statistical tests of this file together is 1e-4: about 100 tests, each at 1e-6. Seeds are fixed.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "methods/contract/errors.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/test_statistics.h"
#include "methods/kit/particles/test_world.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::particles {
namespace {

using test::chiSquareOfSphere;
using test::expectUniform;

using std::numbers::pi;
constexpr std::uint64_t seeds[] = {11, 12, 13};
const glm::dvec3 place{3, -2, 5};

/// A system whose particles are all born in one step of one second and stay at rest, or keep their velocity.
ParticleSystem born(const std::string& position, const std::string& velocity, std::uint64_t seed, int count = 20000) {
    auto system = test::systemFrom(
        "emission = { part = \"stream\", rate_per_metre = 0, rate_per_second = " + std::to_string(count) +
            " }\nposition = { at = \"place\", place = [3, -2, 5], " + position + " }\nvelocity = { " + velocity +
            " }\ncolour = { part = \"constant\" }\nsize = { part = \"constant\" }\n"
            "life = [ { part = \"lifetime\", average_seconds = 1000, variation_seconds = 0 } ]\n",
        seed);
    const scene::Scene scene;
    const scene::SceneState state;
    system.update({scene, state, 1});
    return system;
}

const std::string stillSources = "part = \"fixed\", speed = 0";

/// Returns positions relative to the source's.
std::vector<glm::dvec3> placesOf(const std::string& position, std::uint64_t seed, int count = 20000) {
    const auto system = born(position, stillSources, seed, count);
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < system.store().size(); ++i)
        places.push_back(glm::dvec3(system.store().position(i)) - place);
    return places;
}

std::vector<glm::dvec3> velocitiesOf(const std::string& velocity, std::uint64_t seed,
                                     const std::string& position = "part = \"point\"") {
    const auto system = born(position, velocity, seed);
    const ParticleStore& s = system.store();
    std::vector<glm::dvec3> velocities;
    for (std::size_t i = 0; i < s.size(); ++i) velocities.emplace_back(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
    return velocities;
}

std::vector<double> mapped(const std::vector<glm::dvec3>& vectors, const std::function<double(const glm::dvec3&)>& f) {
    std::vector<double> values;
    values.reserve(vectors.size());
    for (const glm::dvec3& v : vectors) values.push_back(f(v));
    return values;
}

double length(const glm::dvec3& v) {
    return glm::length(v);
}

TEST(LineSource, IsUniformFromItsEndOrAboutItsMiddle) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 0.5, -0.25));
    for (const bool middle : {false, true})
        for (const std::uint64_t seed : seeds) {
            const auto places =
                placesOf(std::string("part = \"line\", direction = [1, 0.5, -0.25], length_metres = 4, base = ") +
                             (middle ? "\"middle\"" : "\"end\""),
                         seed);
            expectUniform(mapped(places, [&](const auto& p) { return glm::dot(p, direction); }), middle ? -2 : 0,
                          middle ? 2 : 4);
            for (const glm::dvec3& p : places) ASSERT_LT(glm::length(glm::cross(p, direction)), 2e-6);
        }
}

TEST(SphereSource, IsUniformExactlyAndByRejection) {
    for (const std::string mode : {"exact", "rejection"})
        for (const std::uint64_t seed : seeds) {
            const auto places = placesOf("part = \"sphere\", radius_metres = 2, mode = \"" + mode + "\"", seed);
            // P(d ≤ x) = (x/R)³
            expectUniform(mapped(places, [](const auto& p) { return std::pow(length(p) / 2, 3); }), 0, 1);
            chiSquareOfSphere(places);
            glm::dvec3 mean(0);
            for (const glm::dvec3& p : places) mean += p / static_cast<double>(places.size());
            // ⟨x²⟩ = R²/5; 4.9 standard errors: 1e-6
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean[k], 0, 4.9 * std::sqrt(4.0 / 5 / 20000));
        }
}

TEST(SphereSource, DenseModeFallsAsTheSquareOfTheDistanceAndCrowdsAtThePoles) {
    for (const std::uint64_t seed : seeds) {
        const auto places = placesOf("part = \"sphere\", radius_metres = 2, mode = \"centre\"", seed);
        // Density ∝ 1/d²: the distance is uniform.
        expectUniform(mapped(places, length), 0, 2);
        expectUniform(mapped(places, [](const auto& p) { return std::asin(p.y / length(p)); }), -pi / 2, pi / 2);
        expectUniform(mapped(places, [](const auto& p) { return std::atan2(p.z, p.x); }), -pi, pi);
        // Compared with a uniform ball: 64 times the density within R/8, and P(|sin β| > 0.99) = 0.09 instead of 0.01.
        double near = 0, polar = 0;
        for (const glm::dvec3& p : places) {
            near += length(p) < 0.25 ? 1 : 0;
            polar += std::abs(p.y) > 0.99 * length(p) ? 1 : 0;
        }
        EXPECT_NEAR(near / 20000 * 512, 64, 64 * 4.9 * std::sqrt(7.0 / 20000));
        EXPECT_NEAR(polar / 20000, 0.0901, 4.9 * std::sqrt(0.09 / 20000));
    }
}

TEST(DiscSource, IsUniform) {
    for (const std::uint64_t seed : seeds) {
        const auto places = placesOf("part = \"disc\", radius_metres = 3", seed);
        expectUniform(mapped(places, [](const auto& p) { return glm::dot(p, p); }), 0, 9);
        expectUniform(mapped(places, [](const auto& p) { return std::atan2(p.z, p.x); }), -pi, pi);
    }
}

TEST(RectangleSource, IsUniformInItsPlane) {
    for (const std::uint64_t seed : seeds) {
        const auto flat = placesOf("part = \"rectangle\", length_metres = 4, width_metres = 1", seed);
        expectUniform(mapped(flat, [](const auto& p) { return p.x; }), -2, 2);
        expectUniform(mapped(flat, [](const auto& p) { return p.z; }), -0.5, 0.5);
        for (const glm::dvec3& p : flat) ASSERT_NEAR(p.y, 0, 1e-6);
        double product = 0;  // the sides are independent: 4.9 standard errors of a product of two uniform numbers
        for (const glm::dvec3& p : flat) product += p.x * p.z / static_cast<double>(flat.size());
        EXPECT_NEAR(product, 0, 4.9 * std::sqrt(16.0 / 12 / 12 / 20000));
        const glm::dvec3 normal = glm::normalize(glm::dvec3(0.5, 1, -0.5));
        for (const glm::dvec3& p :
             placesOf("part = \"rectangle\", length_metres = 4, width_metres = 1, normal = [0.5, 1, -0.5]", seed, 500))
            ASSERT_NEAR(glm::dot(p, normal), 0, 2e-6);
    }
}

class MeshFile : public testing::Test {
 protected:
    /// Writes an OBJ file and returns a source that uses it.
    [[nodiscard]] std::string sourceFrom(const std::string& obj, const std::string& more = "") const {
        return "part = \"mesh\", mesh = \"" + folder_.write("source.obj", obj).string() + "\"" + more;
    }
    static std::string errorOf(const std::string& position) {
        try {
            born(position, stillSources, 1, 10);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    }
    /// A right-angled tetrahedron with legs 1, 2 and 3.
    static inline const std::string tetrahedron =
        "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

 private:
    TestFolder folder_;
};

TEST_F(MeshFile, SurfaceIsUniform) {
    for (const std::uint64_t seed : seeds) {
        const auto places = placesOf(sourceFrom(tetrahedron), seed);
        // Faces z = 0, y = 0, x = 0 and the slanted one.
        const double areas[] = {1, 1.5, 3, 3.5};
        double counts[4]{};
        std::vector<double> onFirst;
        for (const glm::dvec3& p : places) {
            const int face = std::abs(p.z) < 1e-6 ? 0 : std::abs(p.y) < 1e-6 ? 1 : std::abs(p.x) < 1e-6 ? 2 : 3;
            ++counts[face];
            if (face == 3) {
                ASSERT_NEAR(p.x + p.y / 2 + p.z / 3, 1, 1e-6);
            }
            if (face == 2) onFirst.push_back(1 - std::pow(1 - p.z / 3, 2));  // P(z ≤ c) on a right triangle
        }
        double sum = 0;
        for (int k = 0; k < 4; ++k) {
            const double expected = 20000 * areas[k] / 9;
            sum += (counts[k] - expected) * (counts[k] - expected) / expected;
        }
        EXPECT_LT(sum, test::chiSquareLimit(3));
        expectUniform(onFirst, 0, 1);
    }
}

TEST_F(MeshFile, ErrorsAreOneLine) {
    EXPECT_EQ(errorOf(sourceFrom(tetrahedron)), "no error");
    const std::string open = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    EXPECT_NE(errorOf(sourceFrom(open)).find("has a hole (3 open edges"), std::string::npos)
        << errorOf(sourceFrom(open));
    EXPECT_EQ(errorOf(sourceFrom(open, ", open = true")), "no error");
    EXPECT_NE(errorOf(sourceFrom("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")).find("no triangle with an area"),
              std::string::npos);
    EXPECT_NE(errorOf("part = \"mesh\", mesh = \"/nowhere/thing.obj\"").find("/nowhere/thing.obj"), std::string::npos);
    EXPECT_NE(errorOf("part = \"mesh\", mesh = \"harf\"").find("did you mean 'hare'"), std::string::npos);
}

TEST(FixedVelocity, HasOneDirectionAndUniformSpeeds) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 2, -2));
    for (const std::uint64_t seed : seeds) {
        const auto all = velocitiesOf("part = \"fixed\", direction = [0.5, 1, -1], speed = 3, variation = 2", seed);
        expectUniform(mapped(all, [&](const auto& v) { return glm::dot(v, direction); }), 1, 5);
        for (const glm::dvec3& v : all) ASSERT_LT(glm::length(glm::cross(v, direction)), 2e-6);
    }
}

TEST(RandomVelocity, FixedIsUniformAndPaperFavoursCorners) {
    for (const std::uint64_t seed : seeds) {
        const auto fixed = velocitiesOf("part = \"random\", speed = 3, variation = 1", seed);
        chiSquareOfSphere(fixed);
        expectUniform(mapped(fixed, length), 2, 4);
        const auto paper = velocitiesOf("part = \"random\", mode = \"paper\", speed = 3, variation = 0", seed);
        // Within 15 degrees of a corner or of a face's middle; the limit of small caps is 3√3 = 5.2 (claim R19).
        double corners = 0, faces = 0;
        for (const glm::dvec3& v : paper) {
            const glm::dvec3 d = glm::abs(v) / 3.0;
            ASSERT_NEAR(glm::length(d), 1, 1e-6);
            corners += (d.x + d.y + d.z) / std::numbers::sqrt3 > std::cos(pi / 12) ? 1 : 0;
            faces += std::max({d.x, d.y, d.z}) > std::cos(pi / 12) ? 1 : 0;
        }
        EXPECT_GT(corners / 8 / (faces / 6), 2.5);
        EXPECT_LT(corners / 8 / (faces / 6), 5.2);
        EXPECT_GT(test::chiSquareOverSphere(paper), 3 * test::chiSquareLimit(95));
    }
}

TEST(NestedVelocity, FixedIsUniformOnTheZoneAndPaperIsNot) {
    const double inner = std::cos(20 * pi / 180), outer = std::cos(60 * pi / 180);
    const std::string angles = "part = \"nested\", inner_half_angle_degrees = 20, half_angle_degrees = 60, speed = 2";
    const auto cosine = [](const glm::dvec3& v) { return v.y / length(v); };
    for (const std::uint64_t seed : seeds) {
        const auto fixed = velocitiesOf(angles, seed);
        expectUniform(mapped(fixed, cosine), outer, inner);
        expectUniform(mapped(fixed, [](const auto& v) { return std::atan2(v.z, v.x); }), -pi, pi);
        // The paper's: ((β − βmin)/(βmax − βmin))² is uniform, the cosine is not.
        const auto paper = mapped(velocitiesOf(angles + ", mode = \"paper\"", seed), cosine);
        std::vector<double> shares;
        shares.reserve(paper.size());
        for (const double c : paper) shares.push_back(std::pow((std::acos(c) * 180 / pi - 20) / 40, 2));
        expectUniform(shares, 0, 1);
        EXPECT_GT(test::distance(paper, [&](double c) { return (c - outer) / (inner - outer); }), 0.05);
    }
}

TEST(ConeVelocity, FixedIsUniformAndPaperIsNotWhereItIsWide) {
    const std::string cone = "part = \"cone\", half_angle_degrees = 90, speed = 2, variation = 0";
    for (const std::uint64_t seed : seeds) {
        const auto cosine = [](const glm::dvec3& v) { return v.y / 2; };
        expectUniform(mapped(velocitiesOf(cone, seed), cosine), 0, 1);
        const auto paper = mapped(velocitiesOf(cone + ", mode = \"paper\"", seed), cosine);
        EXPECT_NEAR(test::distance(paper, [](double c) { return c; }), 0.056, test::distanceLimit(20000));
    }
}

TEST(AwayVelocity, LeavesTheCentreAndItsSpeedGrowsWithTheDistance) {
    for (const std::uint64_t seed : seeds) {
        const auto system = born("part = \"sphere\", radius_metres = 2",
                                 "part = \"away\", speed = 1, variation = 0, speed_per_metre = 3", seed);
        const ParticleStore& s = system.store();
        for (std::size_t i = 0; i < s.size(); ++i) {
            const glm::dvec3 v(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
            const glm::dvec3 from = glm::dvec3(s.position(i)) - static_cast<double>(s.age[i]) * v - place;
            // The position is rounded by 2e-7 m per metre, the velocity by at most that divided by the distance.
            ASSERT_NEAR(glm::length(v), 1 + 3 * glm::length(from), 2e-5);
            ASSERT_GT(glm::dot(v, from), (1 - 1e-4) * glm::length(v) * glm::length(from) - 1e-5);
        }
        // At the source itself no direction is outward, so any direction is valid.
        chiSquareOfSphere(velocitiesOf("part = \"away\", speed = 1", seed));
    }
}

/// Moments of all births over `seconds`.
std::vector<double> moments(EmissionPart& part, double seconds, double step, std::int64_t particlesPerPuff = 1,
                            double fixedRate = 0) {
    const scene::Scene scene;
    const scene::SceneState state;
    std::vector<double> all;
    for (int i = 0; i < std::lround(seconds / step); ++i) {
        const Births births = part.births({scene, state, step, 1, fixedRate, {}, particlesPerPuff});
        for (std::int64_t k = 0; k < births.count; ++k)
            all.push_back(i * step + births.firstSeconds + static_cast<double>(k) * births.spacingSeconds);
    }
    return all;
}

TEST(Bursts, AreBornWithinTheirDurationWhateverTheStep) {
    for (const double duration : {0.0, 0.01, 0.3, 1.5})
        for (const double step : {0.5, 1.0 / 60, 0.003}) {
            const auto part = makePartOf<EmissionPart>(
                PartKind::emission, "bursts",
                {{"count", "700"}, {"duration_seconds", std::to_string(duration)}, {"interval_seconds", "1.5"}});
            const auto all = moments(*part, 9, step);  // six bursts, and perhaps the seventh at the very end
            ASSERT_GE(all.size(), 4200u - 1);
            ASSERT_LE(all.size(), 4900u);
            for (std::size_t k = 0; k < 4199; ++k) {
                const std::size_t burst = k / 700;
                const double since = all[k] - 1.5 * static_cast<double>(burst);
                ASSERT_NEAR(since, duration * static_cast<double>(k % 700 + 1) / 700, 1e-6) << k;
            }
        }
}

TEST(Bursts, FollowAFixedCountAndThePuffsShares) {
    const auto bursts = [] {
        return makePartOf<EmissionPart>(PartKind::emission, "bursts", {{"count", "10"}, {"interval_seconds", "0.5"}});
    };
    EXPECT_EQ(moments(*bursts(), 9.75, 1.0 / 64).size(), 200u);
    EXPECT_EQ(moments(*bursts(), 9.75, 1.0 / 64, 64).size(), 200u * 64);
    EXPECT_EQ(moments(*bursts(), 9.75, 1.0 / 64, 1, 30).size(), 300u);
}

TEST(Bursts, LastNoLongerThanTheirInterval) {
    EXPECT_THROW((void)makePart(PartKind::emission, "bursts", {{"duration_seconds", "3"}, {"interval_seconds", "2"}}),
                 InputError);
}

TEST(Emission, ARateOfNothingOrOfMoreThanTheMachineHoldsIsOneLine) {
    const auto errorOf = [](const std::string& rate) -> std::string {
        try {
            auto system = test::systemFrom(test::with(test::everyForce, "rate_per_second = 30, rate_per_metre = 25",
                                                      "rate_per_second = " + rate + ", rate_per_metre = 0"));
            const scene::Scene scene = test::sceneWithCar();
            system.update({scene, test::drivingStraight(0, 20), 1.0 / 60});
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_NE(errorOf("0").find("rates of 0"), std::string::npos) << errorOf("0");
    EXPECT_NE(errorOf("1e12").find("800000000000 particles of a system need 4.8e+13 bytes"), std::string::npos)
        << errorOf("1e12");
    EXPECT_EQ(errorOf("1000"), "no error");
}

TEST(BezierColour, PrintedWeightsAre27TimesTooBrightAtBirth) {
    const auto part = makePartOf<ColourPart>(PartKind::colour, "bezier",
                                             {{"mode", "paper"},
                                              {"start.red", "0.5"},
                                              {"early.red", "0.25"},
                                              {"late.red", "0.125"},
                                              {"end.red", "1"},
                                              {"opacity_curve", "bezier"},
                                              {"opacity_start", "0.01"},
                                              {"opacity_early", "0.2"},
                                              {"opacity_late", "0.1"},
                                              {"opacity_end", "0"}});
    std::vector<float> share{0, 0.25f, 0.5f, 1}, red(4), green(4), blue(4), opacity(4);
    Chunk chunk;
    chunk.count = 4;
    chunk.share = share.data();
    chunk.red = red.data(), chunk.green = green.data(), chunk.blue = blue.data(), chunk.opacity = opacity.data();
    const scene::Scene scene;
    const scene::SceneState state;
    part->update(chunk, {scene, state, 1, 1, 0, {}});
    for (std::size_t i = 0; i < 4; ++i) {
        const double t = static_cast<double>(share[i]), s = 3 - t;
        const auto printed = [&](double a, double b, double c, double d) {
            return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
        };
        EXPECT_NEAR(red[i], printed(0.5, 0.25, 0.125, 1), 1e-5);
        EXPECT_NEAR(opacity[i], std::min(0.999, printed(0.01, 0.2, 0.1, 0)), 1e-5);
    }
    EXPECT_NEAR(red[0], 27 * 0.5, 1e-5);
}

}  // namespace
}  // namespace dustbench::particles
