#include "methods/grid_fluid/sight_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/pictures/image.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::grid_fluid::sight {
namespace {

constexpr int width = 160, height = 120;
constexpr glm::ivec3 cells{12, 7, 9};
constexpr double edge = 0.5;
constexpr glm::dvec3 minimum{-3, -1.75, -2.25}, maximum{3, 1.75, 2.25};
constexpr double extinctionPerMetre = 0.5;

scene::View viewOf(const Sight& sight) {
    scene::View view;
    view.width = width;
    view.height = height;
    view.camera.eye = sight.eye;
    view.camera.target = sight.eye + sight.along;
    return view;
}

/// Returns the distance along a ray of length 1 from the eye to the ball; infinite if it misses.
double distanceToBall(const Sight& sight, const glm::dvec3& ray) {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (!sight.ball) return never;
    const glm::dvec3 away = sight.eye - sight.ball->centre;
    const double b = glm::dot(away, ray), c = glm::dot(away, away) - sight.ball->radius * sight.ball->radius;
    const double root = b * b - c;
    return root >= 0 && -b > std::sqrt(root) ? -b - std::sqrt(root) : never;
}

/// Returns the length of the ray inside the box, up to a distance.
double lengthWithin(const glm::dvec3& eye, const glm::dvec3& ray, double end) {
    double start = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (minimum[axis] - eye[axis]) / ray[axis], b = (maximum[axis] - eye[axis]) / ray[axis];
        start = std::max(start, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return std::max(end - start, 0.0);
}

/// The depth buffer of the ball: reversed depths, rows from the bottom.
std::vector<float> depthsOf(const Sight& sight, const scene::View& view) {
    const glm::dvec3 forward = glm::normalize(sight.along);
    std::vector<float> depths;
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
            const double along = distanceToBall(sight, ray) * glm::dot(ray, forward);
            depths.push_back(static_cast<float>(std::min(view.camera.nearMetres / along, 1.0)));
        }
    return depths;
}

/// `seen`: the input of the ray caster; the ground truth always belongs to `sight`.
double maximumError(gpu::Device& device, const raycast::RaycastSettings& settings, const Sight& sight,
                    const Sight& seen) {
    const scene::View view = viewOf(sight);
    gpu::Texture depth = gpu::Texture::make2D(device, "sight: depth", gpu::Format::depth32F, width, height);
    depth.write(std::span<const float>(depthsOf(seen, view)));
    gpu::Layer layer(device, depth);
    layer.clear();
    MemoryLedger ledger;
    raycast::GridRaycast raycast(device, settings, scene::Lights(), ledger);
    const std::vector<float> density(static_cast<std::size_t>(cells.x * cells.y * cells.z), 1.0f);
    raycast.upload({cells, edge, minimum, density, {}});
    raycast.draw(view, layer);
    const pictures::Image image = draw::readBack(layer.colour());
    double worst = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
            const double within = lengthWithin(sight.eye, ray, distanceToBall(sight, ray));
            const double exact = -std::expm1(-extinctionPerMetre * within);
            worst = std::max(worst, std::abs(static_cast<double>(image.at(x, y).a) - exact));
        }
    return worst;
}

}  // namespace

double maximumSightError(gpu::Device& device, const raycast::RaycastSettings& settings,
                         const std::vector<Sight>& sights) {
    raycast::RaycastSettings ours = settings;
    ours.extinctionPerMetre = extinctionPerMetre;
    double maximum = 0;
    for (const Sight& sight : sights) maximum = std::max(maximum, maximumError(device, ours, sight, sight));
    return maximum;
}

namespace {

/// A ray caster that ignores the ball in front of the box.
double errorOfUnseenBall(gpu::Device& device) {
    raycast::RaycastSettings settings;
    settings.stopAlpha = 1;
    settings.extinctionPerMetre = extinctionPerMetre;
    const Sight ball{{0.3, 0.2, 9}, {0, 0, -1}, Sight::Ball{{0.4, 0, 5}, 0.6}};
    return maximumError(device, settings, ball, {ball.eye, ball.along, {}});
}

std::vector<Finding> measureBoxErrors(gpu::Device& device) {
    const glm::dvec3 front{0.3, 0.2, 9}, corner{6, 4, 7}, inside{0.1, 0.2, 0.3};
    const std::vector<std::pair<std::string, std::vector<Sight>>> kinds{
        {"free", {{front, {0, 0, -1}, {}}, {corner, -corner, {}}, {{0, 0, 9}, {0.1, 0, 1}, {}}}},
        {"solid",
         {{front, {0, 0, -1}, Sight::Ball{{0.4, 0, 5}, 0.6}},
          {front, {0, 0, -1}, Sight::Ball{{-0.5, 0.3, 0}, 1.2}},
          {corner, -corner, Sight::Ball{maximum, 1.5}},
          {corner, -corner, Sight::Ball{-corner, 3}}}},
        {"inside",
         {{inside, {1, 0.3, 0.2}, {}},
          {{0, 0, maximum.z + 0.05}, {0, 0.1, -1}, {}},
          {{maximum.x + 0.03, 0.5, 0}, {-1, 0, 0.9}, {}},
          {inside, {-1, 0.1, -0.4}, Sight::Ball{{-1.2, 0.2, -0.2}, 0.5}}}}};
    std::vector<Finding> findings;
    for (const auto& [name, backend] : {std::pair{"gl", raycast::Backend::gl}, {"cpu", raycast::Backend::cpu}})
        for (const auto& [kind, sights] : kinds) {
            raycast::RaycastSettings settings;
            settings.backend = backend;
            settings.stopAlpha = 1;
            const double error = maximumSightError(device, settings, sights);
            findings.push_back(
                {kind + "_" + name, error, error, error, static_cast<std::int64_t>(sights.size()) * width * height});
        }
    const double unseen = errorOfUnseenBall(device);
    findings.push_back({"solid_unseen", unseen, unseen, unseen, std::int64_t{width} * height});
    return findings;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures the ray caster's error in a homogeneous box, with and without solids.";
    info.source = "Senger2009";
    info.run = [](ExperimentContext& context) { return measureBoxErrors(context.device()); };
    return info;
}

}  // namespace dustbench::grid_fluid::sight
