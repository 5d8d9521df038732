#include "methods/kit/particles/sampling_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "methods/kit/maths/philox.h"

namespace dustbench::particles::sampling {
namespace {

constexpr double z95 = 1.959964;
constexpr double radians = std::numbers::pi / 180;
enum Stream : std::uint32_t { cubeStream = 1, gaussianStream, coneStream };

using Direction = std::function<glm::dvec3(std::int64_t)>;

glm::dvec3 cubePoint(std::uint64_t seed, std::int64_t i) {
    const auto u = maths::uniform4(seed, cubeStream, static_cast<std::uint64_t>(i));
    return 2.0 * glm::dvec3(u[0], u[1], u[2]) - 1.0;
}

/// Box–Muller, twice; the fourth number is dropped.
glm::dvec3 gaussianPoint(std::uint64_t seed, std::int64_t i) {
    const auto u = maths::uniform4(seed, gaussianStream, static_cast<std::uint64_t>(i));
    const auto radius = [](float uniform) { return std::sqrt(-2 * std::log(1 - static_cast<double>(uniform))); };
    const double first = radius(u[0]), second = radius(u[2]);
    const double turn = 2 * std::numbers::pi * static_cast<double>(u[1]);
    return {first * std::cos(turn), first * std::sin(turn),
            second * std::cos(2 * std::numbers::pi * static_cast<double>(u[3]))};
}

/// A point of the four-dimensional cube.
glm::dvec4 hypercubePoint(std::uint64_t seed, std::int64_t i) {
    const auto u = maths::uniform4(seed, cubeStream, static_cast<std::uint64_t>(i));
    return 2.0 * glm::dvec4(u[0], u[1], u[2], u[3]) - 1.0;
}

/// For points in the cube of `Point`'s dimensions; `name` is appended to the quantities.
template <typename Point>
void findAcceptance(const std::string& name, std::uint64_t seed, std::int64_t draws, std::vector<Finding>& findings) {
    std::int64_t inside = 0;
    for (std::int64_t i = 0; i < draws; ++i) {
        const Point point(hypercubePoint(seed, i));
        inside += glm::dot(point, point) <= 1 ? 1 : 0;
    }
    const double n = static_cast<double>(draws), p = static_cast<double>(inside) / n;
    const double middle = (p + z95 * z95 / (2 * n)) / (1 + z95 * z95 / n);
    const double half = z95 / (1 + z95 * z95 / n) * std::sqrt(p * (1 - p) / n + z95 * z95 / (4 * n * n));
    findings.push_back({"acceptance" + name, p, middle - half, middle + half, draws});
    findings.push_back({"tries_per_point" + name, 1 / p, 1 / (middle + half), 1 / (middle - half), draws});
}

/// Counts directions within 4 degrees of a cube's corners and of its faces' centres, per corner and per face.
void findCornersOverFaces(const std::string& name, const Direction& direction, std::int64_t draws,
                          std::vector<Finding>& findings) {
    const double cap = std::cos(4 * radians);
    double corners = 0, faces = 0;
    for (std::int64_t i = 0; i < draws; ++i) {
        // By symmetry, fold into the first octant: its corner, and the faces' centres on its axes.
        const glm::dvec3 d = glm::abs(direction(i));
        corners += (d.x + d.y + d.z) / std::numbers::sqrt3 > cap ? 1 : 0;
        faces += std::max({d.x, d.y, d.z}) > cap ? 1 : 0;
    }
    const double ratio = (corners / 8) / (faces / 6);
    const double half = z95 * std::sqrt(1 / corners + 1 / faces);  // of the logarithm of the ratio of two Poisson
                                                                   // counts
    findings.push_back({"corner_over_face_" + name, ratio, ratio * std::exp(-half), ratio * std::exp(half), draws});
}

/// Eight bands of equal height times twelve sectors: cells of equal area (Archimedes).
void findChiSquare(const std::string& name, const Direction& direction, std::int64_t draws,
                   std::vector<Finding>& findings) {
    constexpr int bands = 8, sectors = 12, cells = bands * sectors;
    std::array<double, cells> counts{};
    for (std::int64_t i = 0; i < draws; ++i) {
        const glm::dvec3 d = direction(i);
        const int band = std::clamp(static_cast<int>((d.z + 1) / 2 * bands), 0, bands - 1);
        const double turns = std::atan2(d.y, d.x) / (2 * std::numbers::pi) + 0.5;
        const int sector = std::clamp(static_cast<int>(turns * sectors), 0, sectors - 1);
        ++counts[static_cast<std::size_t>(band * sectors + sector)];
    }
    const double expected = static_cast<double>(draws) / cells, freedom = cells - 1;
    double sum = 0;
    for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
    // A χ² variable of mean k + λ has variance 2k + 4λ.
    const double away = std::max(0.0, sum - freedom);
    const double half = z95 * std::sqrt(2 * freedom + 4 * away);
    findings.push_back(
        {"chi2_per_cell_" + name, sum / freedom, std::max(0.0, sum - half) / freedom, (sum + half) / freedom, draws});
}

/// `cosineOf(u)`: cosine of the angle to the axis. For uniform directions it is uniform between the cone's cosines.
void findDistance(const std::string& name, double minimumDegrees, double maximumDegrees, std::uint64_t seed,
                  std::int64_t draws, const std::function<double(double)>& cosineOf, std::vector<Finding>& findings) {
    const double inner = std::cos(minimumDegrees * radians), outer = std::cos(maximumDegrees * radians);
    std::vector<double> places;
    places.reserve(static_cast<std::size_t>(draws));
    for (std::int64_t i = 0; i < draws; ++i) {
        const auto u = static_cast<double>(maths::uniform4(seed, coneStream, static_cast<std::uint64_t>(i))[0]);
        places.push_back((inner - cosineOf(u)) / (inner - outer));
    }
    std::ranges::sort(places);
    const auto count = static_cast<double>(draws);
    double distance = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double below = static_cast<double>(i) / count, above = static_cast<double>(i + 1) / count;
        distance = std::max({distance, above - places[i], places[i] - below});
    }
    const double half = std::sqrt(std::log(2 / 0.05) / (2 * count));
    findings.push_back({name, distance, std::max(0.0, distance - half), distance + half, draws});
}

}  // namespace

std::vector<Finding> sampleDirections(std::uint64_t seed, std::int64_t draws) {
    std::vector<Finding> findings;
    findAcceptance<glm::dvec3>("", seed, draws, findings);
    findAcceptance<glm::dvec2>("_disc", seed, draws, findings);
    findAcceptance<glm::dvec4>("_4d", seed, draws, findings);
    const std::array<std::pair<std::string, Direction>, 2> directions{
        std::pair{"cube", [seed](std::int64_t i) { return glm::normalize(cubePoint(seed, i)); }},
        std::pair{"gaussian", [seed](std::int64_t i) { return glm::normalize(gaussianPoint(seed, i)); }}};
    for (const auto& [name, direction] : directions) {
        findCornersOverFaces(name, direction, draws, findings);
        findChiSquare(name, direction, draws, findings);
    }
    struct ConeCase {
        const char* name;
        double minimum, maximum;
    };
    for (const ConeCase& cone : {ConeCase{"cone30", 0, 30}, {"cone90", 0, 90}, {"nested20_30", 20, 30}}) {
        const double minimum = cone.minimum * radians, maximum = cone.maximum * radians;
        const auto asPrinted = [=](double u) { return std::cos(minimum + std::sqrt(u) * (maximum - minimum)); };
        const auto byCosine = [=](double u) { return std::cos(minimum) + u * (std::cos(maximum) - std::cos(minimum)); };
        findDistance(cone.name, cone.minimum, cone.maximum, seed, draws, asPrinted, findings);
        findDistance(std::string(cone.name) + "_by_cosine", cone.minimum, cone.maximum, seed, draws, byCosine,
                     findings);
    }
    return findings;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures how uniform the thesis's random points and directions are, as printed and corrected.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) { return sampleDirections(context.seed(), 4'000'000); };
    return info;
}

}  // namespace dustbench::particles::sampling
