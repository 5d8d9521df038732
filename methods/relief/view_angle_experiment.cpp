#include "methods/relief/view_angle_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "methods/relief/particles/relief_particles.h"
#include "methods/relief/relief_studio.h"
#include "methods/relief/surface/surface_hit.h"

namespace dustbench::relief::view_angle {
namespace {

constexpr int width = 320, height = 200;
constexpr std::array angles{0, 45, 70, 80, 86};
constexpr std::array steps{8, 15, 30, 60, 120, 240};
constexpr double missedTexels = 3;

/// Distance along the ray to its first point on the relief; negative: there is none.
double exactDistance(const DepthMap& map, const scene::Panel& panel, const glm::dvec3& eye, const glm::dvec3& way) {
    const glm::dvec3 low(-panel.sizeMetres / 2.0, -panel.depthMetres), high(panel.sizeMetres / 2.0, 0);
    const glm::dvec3 a = (low - eye) / way, b = (high - eye) / way;
    const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
    const double enter = std::max({near.x, near.y, near.z, 0.0}), leave = std::min({far.x, far.y, far.z});
    if (enter >= leave) return -1;
    const TexelFrame texels(panel);
    const auto share = firstHit(map, texels.toTexels(eye + enter * way), texels.toTexels(eye + leave * way));
    return share ? enter + *share * (leave - enter) : -1;
}

Finding findingOf(const std::string& quantity, const std::vector<Seen>& seen, std::int64_t Seen::*missed) {
    std::int64_t pixels = 0, misses = 0;
    double low = 1, high = 0;
    for (const Seen& one : seen) {
        pixels += one.pixels, misses += one.*missed;
        low = std::min(low, one.ofPixels(one.*missed)), high = std::max(high, one.ofPixels(one.*missed));
    }
    return {quantity, static_cast<double>(misses) / static_cast<double>(pixels), low, high, pixels};
}

/// Increase of the missed share from 0° to 70° by one method, minus that by another.
void addDependences(std::vector<Finding>& findings) {
    const auto dependence = [&](const std::string& way) {
        const auto missed = [&](const char* angle) {
            return std::ranges::find(findings, "missed_" + way + angle, &Finding::quantity)->value;
        };
        return missed("_70") - missed("_0");
    };
    const std::int64_t pixels = findings.front().samples;
    for (const auto& [name, of, over] : {std::tuple("relief_over_bump", "15", "bump"),
                                         {"relief_over_mesh", "15", "mesh"},
                                         {"mesh_over_bump", "mesh", "bump"},
                                         {"bump_over_mesh", "bump", "mesh"}}) {
        const double lead = dependence(over) - dependence(of);
        findings.push_back({name, lead, lead, lead, pixels});
    }
}

std::vector<Finding> measured(ExperimentContext& context) {
    const auto world = context.world("relief_wall", {}, width, height);
    std::vector<std::pair<std::string, ReliefStyle>> ways;
    ways.reserve(std::size(steps) + 2);
    for (const int each : steps)
        ways.emplace_back(std::to_string(each), ReliefStyle{March::paper, each, 5, false, false});
    ways.emplace_back("safe", ReliefStyle{.march = March::safe, .shadow = false});
    ways.emplace_back("mesh", ReliefStyle{.march = March::mesh, .shadow = false});
    std::vector<Finding> findings;
    for (const auto& [name, style] : ways)
        for (const int angle : angles) {
            std::vector<Seen> seen;
            for (const scene::Panel& panel : world->scene().panels)
                seen.push_back(seenAt(context.device(), world->scene(), panel, style, angle));
            findings.push_back(findingOf("missed_" + name + "_" + std::to_string(angle), seen, &Seen::missed));
            if (style.march == March::safe)
                findings.push_back(findingOf("missed_bump_" + std::to_string(angle), seen, &Seen::bumpMissed));
        }
    addDependences(findings);
    return findings;
}

}  // namespace

Seen seenAt(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel, const ReliefStyle& style,
            double degrees) {
    const scene::View view = viewOf(panel, degrees, width, height);
    ReliefStudio studio(device, scene, panel, style, view);
    studio.draw();
    const std::vector<float> depths = studio.depths();
    const glm::dmat4 toPanel = glm::inverse(panel.toParent);
    const glm::dvec3 eye(toPanel * glm::dvec4(view.camera.eye, 1));
    const glm::dvec3 axis = glm::normalize(view.camera.target - view.camera.eye);
    const double tolerance = missedTexels * panel.sizeMetres.x / panel.relief->columns;
    Seen seen;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 ray(view.rayDirection(x + 0.5, y + 0.5));
            const glm::dvec3 way(toPanel * glm::dvec4(ray, 0));
            const double exact = exactDistance(studio.surface().depths(), panel, eye, way);
            if (exact < 0) continue;
            ++seen.pixels;
            const auto depth = static_cast<double>(depths[static_cast<std::size_t>((height - 1 - y) * width + x)]);
            const double shown = depth > 0 ? view.camera.nearMetres / (depth * glm::dot(axis, ray)) : HUGE_VAL;
            seen.missed += std::abs(shown - exact) > tolerance ? 1 : 0;
            // The face is the panel's plane z = 0.
            const glm::dvec3 onRelief = eye + exact * way, onFace = eye - eye.z / way.z * way;
            seen.bumpMissed += glm::distance(glm::dvec2(onRelief), glm::dvec2(onFace)) > tolerance ? 1 : 0;
        }
    return seen;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures the pixels that a march over a relief misses, by viewing angle and number of steps.";
    info.source = "Bergeron";
    info.run = measured;
    return info;
}

}  // namespace dustbench::relief::view_angle
