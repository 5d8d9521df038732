#include "methods/kit/particles/part_costs_experiment.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "methods/kit/findings/findings.h"
#include "methods/kit/findings/timing.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/meshes/triangle_tree.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_system.h"

namespace dustbench::particles::part_costs {
namespace {

using findings::secondsOf;
using Work = std::function<void()>;

/// Appends `repetitions` ratios of the time of `above` to that of `below`, after one run of each.
void addRatios(std::vector<double>& ratios, int repetitions, const Work& above, const Work& below) {
    above();
    below();
    for (int k = 0; k < repetitions; ++k) {
        const double first = secondsOf(above);
        ratios.push_back(first / secondsOf(below));
    }
}

/// Their median.
Finding timeRatio(std::string quantity, int repetitions, const Work& above, const Work& below) {
    std::vector<double> ratios;
    addRatios(ratios, repetitions, above, below);
    return findings::medianOf(std::move(quantity), std::move(ratios));
}

/// So that the compiler can neither leave out the work nor move it out of the timed section.
void need(float sum) {
    volatile float needed = sum;
    static_cast<void>(needed);
}

// --- Points in a ball.

/// Uniform numbers, drawn before the measurement, because the thesis's generator cost less than ours.
class Numbers {
 public:
    Numbers(std::uint64_t seed, std::size_t count) : values_(4 * count) {
        for (std::size_t i = 0; i < count; ++i) std::ranges::copy(maths::uniform4(seed, 1, i), &values_[4 * i]);
    }
    float next() {
        if (at_ == values_.size()) at_ = 0;
        return values_[at_++];
    }

 private:
    std::vector<float> values_;
    std::size_t at_ = 0;
};

[[gnu::noinline]] glm::vec3 pointByRejection(Numbers& numbers) {
    return maths::ballPointByRejection([&](std::uint32_t) {
        const float x = numbers.next(), y = numbers.next();
        return 2.0f * glm::vec3(x, y, numbers.next()) - 1.0f;
    });
}

/// d = ∛u, cos θ = 1 − 2v, φ = 2πw.
[[gnu::noinline]] glm::vec3 pointByAngles(Numbers& numbers) {
    const float distance = std::cbrt(numbers.next());
    const float polar = std::acos(1.0f - 2.0f * numbers.next());
    const float azimuth = 2 * std::numbers::pi_v<float> * numbers.next();
    return distance *
           glm::vec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
}

void measureBall(std::uint64_t seed, const Sizes& sizes, std::vector<Finding>& findings) {
    Numbers numbers(seed, sizes.particles);
    const auto drawing = [&](const auto& point, std::size_t count) {
        return [&numbers, &sizes, point, count] {
            glm::vec3 sum(0);
            for (std::size_t i = 0; i < count * sizes.particles; ++i) sum += point(numbers);
            need(sum.x + sum.y + sum.z);
        };
    };
    const int repetitions = 5 * sizes.repetitions;  // they are short
    const Work rejection = drawing(pointByRejection, 1), angles = drawing(pointByAngles, 1),
               twice = drawing(pointByRejection, 2);
    findings.push_back(timeRatio("rejection_over_angles", repetitions, rejection, angles));
    findings.push_back(timeRatio("rejection_over_two_rejections", repetitions, rejection, twice));
    findings.push_back(timeRatio("rejection_of_equals", repetitions, rejection, rejection));
}

// --- Steps of a system.

constexpr double stepSeconds = 1.0 / 60;

struct Parts {
    std::string position = R"(part = "point", at = "place")";
    std::string colour = R"(part = "constant")";
    std::string forces = "";
    double lifetimeSeconds = 200 * stepSeconds, variationSeconds = 100 * stepSeconds;
};

class SteppedSystem {
 public:
    SteppedSystem(const Parts& parts, std::uint64_t seed, std::size_t particles)
        : system_(partsFromText(fmt::format(R"(
emission = {{ part = "stream", rate_per_second = 100 }}
position = {{ {} }}
velocity = {{ part = "cone", half_angle_degrees = 30, speed = 3 }}
colour = {{ {} }}
size = {{ part = "constant" }}
life = [ {{ part = "lifetime", average_seconds = {}, variation_seconds = {} }} ]
force = [ {} ]
)",
                                            parts.position, parts.colour, parts.lifetimeSeconds, parts.variationSeconds,
                                            parts.forces),
                                "part_costs"),
                  seed),
          particles_(static_cast<std::int64_t>(particles)) {
        const double longestSeconds = parts.lifetimeSeconds + parts.variationSeconds;
        for (double time = 0; time < longestSeconds; time += stepSeconds) step();  // until births and deaths balance
    }
    void step() { system_.update({scene_, state_, stepSeconds, particles_}); }
    [[nodiscard]] Work steps() {
        return [this] {
            constexpr int count = 5;
            for (int k = 0; k < count; ++k) step();
        };
    }

 private:
    scene::Scene scene_;
    scene::SceneState state_;
    ParticleSystem system_;
    std::int64_t particles_;
};

/// The time of a step of one system over that of another. Both are made several times, because their speed also depends
/// on the memory that they happen to get.
Finding stepRatio(std::string quantity, std::uint64_t seed, const Sizes& sizes, const Parts& above,
                  const Parts& below) {
    constexpr int makes = 5;
    std::vector<double> ratios;
    for (int make = 0; make < makes; ++make) {
        SteppedSystem first(above, seed, sizes.particles), second(below, seed, sizes.particles);
        addRatios(ratios, sizes.repetitions, first.steps(), second.steps());
    }
    return findings::medianOf(std::move(quantity), std::move(ratios));
}

void measureSources(std::uint64_t seed, const Sizes& sizes, std::vector<Finding>& findings) {
    const auto from = [](const std::string& source) {
        // Every particle is born and dies within a step or two, so a step consists mostly of births.
        return Parts{.position = source, .lifetimeSeconds = stepSeconds, .variationSeconds = 0};
    };
    const Parts point = from(R"(part = "point", at = "place")"), line = from(R"(part = "line", at = "place")"),
                disc = from(R"(part = "disc", at = "place")"), ball = from(R"(part = "sphere", at = "place")");
    findings.push_back(stepRatio("point_over_line_source", seed, sizes, point, line));
    findings.push_back(stepRatio("point_over_disc_source", seed, sizes, point, disc));
    findings.push_back(stepRatio("point_over_ball_source", seed, sizes, point, ball));
    findings.push_back(stepRatio("ball_over_point_source", seed, sizes, ball, point));
}

void measureColours(std::uint64_t seed, const Sizes& sizes, std::vector<Finding>& findings) {
    const Parts constant, linear{.colour = R"(part = "linear", end = [0, 0, 0])"},
        sixPoints{.colour = R"(part = "bezier_points")"};
    findings.push_back(stepRatio("constant_over_linear_colour", seed, sizes, constant, linear));
    findings.push_back(stepRatio("constant_over_six_points_colour", seed, sizes, constant, sixPoints));
    findings.push_back(stepRatio("colour_of_equals", seed, sizes, constant, constant));
}

void measureBounces(std::uint64_t seed, const Sizes& sizes, std::vector<Finding>& findings) {
    const auto bouncing = [](const std::string& mode, int discs) {
        Parts parts{.position = R"(part = "sphere", at = "place", place = [0, 4, 0], radius_metres = 1)",
                    .forces = R"({ part = "gravity" })"};
        for (int k = 0; k < discs; ++k)
            parts.forces += fmt::format(
                R"(, {{ part = "bounce", mode = "{}", shape = "disc", place = [{}, {}, 0], radius_metres = 3 }})", mode,
                2 * (k % 2), 1 - k);
        return parts;
    };
    const Parts printed = bouncing("paper", 2), exact = bouncing("fixed", 2);
    findings.push_back(stepRatio("bounce_printed_over_exact", seed, sizes, printed, exact));
    findings.push_back(stepRatio("one_bounce_over_eight", seed, sizes, bouncing("fixed", 1), bouncing("fixed", 8)));
    findings.push_back(stepRatio("bounce_of_equals", seed, sizes, exact, exact));
}

// --- Collisions with a mesh.

using Facet = std::array<glm::vec3, 3>;

constexpr int meridians = 40, parallels = 16;

/// The unit sphere of 2·40·16 triangles.
scene::Mesh ballMesh() {
    scene::Mesh mesh;
    for (int i = 0; i <= parallels; ++i)
        for (int j = 0; j < meridians; ++j) {
            const double polar = std::numbers::pi * i / parallels, azimuth = 2 * std::numbers::pi * j / meridians;
            mesh.positions.emplace_back(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                        std::sin(polar) * std::sin(azimuth));
        }
    for (std::uint32_t i = 0; i < parallels; ++i)
        for (std::uint32_t j = 0; j < meridians; ++j) {
            const std::uint32_t next = (j + 1) % meridians, a = i * meridians + j, b = i * meridians + next,
                                c = a + meridians, d = b + meridians;
            for (const std::uint32_t corner : {a, b, c, b, d, c}) mesh.indices.push_back(corner);
        }
    return mesh;
}

struct Path {
    glm::vec3 from, to;
};

/// The share of the path at which it crosses the facet, by Cramer's rule.
std::optional<float> crossing(const Facet& facet, const Path& path) {
    const glm::vec3 way = path.to - path.from, e1 = facet[1] - facet[0], e2 = facet[2] - facet[0];
    const glm::vec3 p = glm::cross(way, e2), s = path.from - facet[0], q = glm::cross(s, e1);
    const float determinant = glm::dot(e1, p);
    if (determinant == 0) return std::nullopt;
    const float u = glm::dot(s, p) / determinant, v = glm::dot(way, q) / determinant,
                share = glm::dot(e2, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || share < 0 || share > 1) return std::nullopt;
    return share;
}

float nearestCrossing(const std::vector<Facet>& facets, const Path& path) {
    float nearest = 2;
    for (const Facet& facet : facets)
        if (const auto share = crossing(facet, path)) nearest = std::min(nearest, *share);
    return nearest;
}

/// Whether the path comes nearer than 1 to the origin.
bool meetsUnitBall(const Path& path) {
    const glm::vec3 way = path.to - path.from;
    const float share = std::clamp(-glm::dot(path.from, way) / glm::dot(way, way), 0.0f, 1.0f);
    const glm::vec3 nearest = path.from + share * way;
    return glm::dot(nearest, nearest) <= 1;
}

/// Of particles at 6 m/s for a step of 1/60 s, uniform in a cube with three times the mesh's edge.
std::vector<Path> pathsNear(std::uint64_t seed, std::size_t count) {
    constexpr float halfEdge = 3, length = 0.1f;
    std::vector<Path> paths;
    for (std::size_t i = 0; i < count; ++i) {
        const auto u = maths::uniform4(seed, 2, i), v = maths::uniform4(seed, 3, i);
        const glm::vec3 from = halfEdge * (2.0f * glm::vec3(u[0], u[1], u[2]) - 1.0f);
        paths.push_back({from, from + length * maths::sphereDirection(v[0], v[1])});
    }
    return paths;
}

void measureMeshes(std::uint64_t seed, const Sizes& sizes, std::vector<Finding>& findings) {
    const scene::Mesh mesh = ballMesh();
    std::vector<Facet> facets;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        facets.push_back({mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                          mesh.positions[mesh.indices[i + 2]]});
    meshes::TriangleTree tree;
    tree.add(mesh, glm::mat4(1));
    tree.build();
    const std::vector<Path> paths = pathsNear(seed, sizes.paths);
    const auto hitsOf = [&](const auto& isHit) { return static_cast<double>(std::ranges::count_if(paths, isHit)); };
    const auto byFacets = [&](const Path& path) { return nearestCrossing(facets, path) <= 1; };
    const auto bySphere = [&](const Path& path) { return meetsUnitBall(path) && byFacets(path); };
    const auto byTree = [&](const Path& path) { return tree.firstHit(path.from, path.to).has_value(); };
    const auto counting = [&](const auto& isHit) {
        return [&hitsOf, isHit] { need(static_cast<float>(hitsOf(isHit))); };
    };
    const Work allFacets = counting(byFacets), sphereFirst = counting(bySphere), treeOfBoxes = counting(byTree);
    findings.push_back(timeRatio("sphere_over_facets", sizes.repetitions, sphereFirst, allFacets));
    findings.push_back(timeRatio("tree_over_sphere", sizes.repetitions, treeOfBoxes, sphereFirst));
    findings.push_back(timeRatio("facets_of_equals", sizes.repetitions, allFacets, allFacets));
    const double hits = hitsOf(byFacets);
    for (const auto& [quantity, found] :
         {std::pair("hits_of_sphere", hitsOf(bySphere)), std::pair("hits_of_tree", hitsOf(byTree))})
        findings.push_back({quantity, found / hits, found / hits, found / hits, static_cast<std::int64_t>(hits)});
}

}  // namespace

std::vector<Finding> measurePartCosts(std::uint64_t seed, const Sizes& sizes) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    std::vector<Finding> findings;
    for (const auto measure : {measureBall, measureSources, measureColours, measureBounces, measureMeshes})
        measure(seed, sizes, findings);
    return findings;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary =
        "Measures the cost of parts that the thesis calls fast or efficient over that of their alternatives.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) {
        return measurePartCosts(context.seed(), {100'000, 10'000, context.quick() ? 9 : 25});
    };
    return info;
}

}  // namespace dustbench::particles::part_costs
