#include "methods/voxel_shape/resolution_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/findings/findings.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_builder.h"
#include "methods/voxel_shape/voxel_shape.h"

namespace dustbench::voxel_shape::resolution {
namespace {

constexpr std::array shapes{"bunny", "car", "figure", "helicopter"};
constexpr int coarsest = 10, finest = 120, between = 10;
constexpr int width = 320, height = 240;
constexpr int settlingSteps = 12;
constexpr std::uint32_t particlesAVoxel = 6;  // as in the preset `figure` with 40,000 particles at 50 voxels per side
constexpr std::uint64_t seeds = 5;
constexpr std::array sidesDegrees{20.0, 140.0, 260.0};

/// Returns a preset at rest at the world's origin.
Shape atRest(const std::string& name, int voxelsASide) {
    Shape shape = readShape(files::findData("shape", "shapes", name, ".toml"));
    shape.track.followsVehicle = false;
    shape.track.keys = {{}};
    shape.collidesWith = {.solids = false};
    shape.resolution = voxelsASide;
    shape.voxels.maximumDensity = particlesAVoxel;
    shape.look.pixels = 0;  // the size of the particles
    return shape;
}

/// Returns a view from one side, far enough to show the whole mesh.
scene::View viewOf(const scene::Mesh& mesh, double degrees) {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    scene::View view;
    view.width = width;
    view.height = height;
    view.camera.target = glm::dvec3(low + high) / 2.0;
    const double distance = 1.1 * static_cast<double>(glm::length(high - low)) / view.camera.verticalFieldOfView;
    const double around = glm::radians(degrees);
    view.camera.eye = view.camera.target + distance * glm::dvec3(std::cos(around), 0.25, std::sin(around));
    return view;
}

/// The knee of an outline that improves linearly up to 100 voxels per side and not beyond: 100.
double kneeOfLateCurve() {
    Curve curve;
    for (int side = coarsest; side <= finest; side += between) {
        curve.voxelsASide.push_back(side);
        curve.overlaps.push_back(std::min(side / 100.0, 1.0));
    }
    return curve.knee();
}

double overlapAt(const Shape& shape, const scene::Scene& scene, const Frame& frame, std::uint64_t seed,
                 gpu::Device& device) {
    VoxelShape method(shape);
    method.prepare(scene, {.seed = seed}, device);
    for (int step = 0; step < settlingSteps; ++step) method.update(frame);
    const scene::Mesh mesh = meshOf(shape, scene);
    double sum = 0;
    for (const double degrees : sidesDegrees) sum += method.silhouetteOverlap(viewOf(mesh, degrees)).value_or(0);
    return sum / static_cast<double>(sidesDegrees.size());
}

/// The mean, its interval widened by `resolved`, the resolution of the values.
Finding meanOf(const std::string& quantity, const std::vector<double>& values, double resolved) {
    Finding finding = findings::meanOf(quantity, values);
    finding.low -= resolved;
    finding.high += resolved;
    return finding;
}

}  // namespace

double Curve::knee() const {
    if (overlaps.empty()) return 0;
    const double first = overlaps.front(), rise = overlaps.back() - first;
    const auto across = static_cast<double>(voxelsASide.back() - voxelsASide.front());
    std::size_t knee = 0;
    double highest = 0;
    for (std::size_t i = 0; i < overlaps.size(); ++i) {
        const double line = across > 0 ? static_cast<double>(voxelsASide[i] - voxelsASide.front()) / across : 0;
        const double above = overlaps[i] - first - rise * line;
        if (above <= highest) continue;
        highest = above;
        knee = i;
    }
    return voxelsASide[knee];
}

Curve outlineOf(ExperimentContext& context, const std::string& shape, std::uint64_t seed) {
    const auto world = context.world("plain", {{"particles", "10"}, {"preroll", "0"}}, width, height);
    const Frame frame = world->step();
    Curve curve;
    for (int side = coarsest; side <= finest; side += between) {
        curve.voxelsASide.push_back(side);
        curve.overlaps.push_back(overlapAt(atRest(shape, side), world->scene(), frame, seed, context.device()));
    }
    return curve;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Finds how many voxels per side a shape needs to keep the outline of its mesh.";
    info.source = "JuckelBeckhaus2007";
    info.run = [](ExperimentContext& context) {
        std::vector<Finding> findings;
        for (const std::string shape : shapes) {
            std::vector<double> knees, atFifty, atFinest, kept, keptAtTen, keptBeforeLast;
            for (std::uint64_t seed = context.seed(); seed < context.seed() + seeds; ++seed) {
                const Curve curve = outlineOf(context, shape, seed);
                knees.push_back(curve.knee());
                const auto fifty = std::ranges::find(curve.voxelsASide, 50) - curve.voxelsASide.begin();
                atFifty.push_back(curve.overlaps[static_cast<std::size_t>(fifty)]);
                atFinest.push_back(curve.overlaps.back());
                kept.push_back(atFifty.back() / atFinest.back());
                keptAtTen.push_back(curve.overlaps.front() / atFinest.back());
                keptBeforeLast.push_back(*(curve.overlaps.end() - 2) / atFinest.back());
            }
            findings.push_back(meanOf("silhouette_knee_" + shape, knees, between / 2.0));
            findings.push_back(meanOf("silhouette_at_50_" + shape, atFifty, 0));
            findings.push_back(meanOf("silhouette_at_120_" + shape, atFinest, 0));
            findings.push_back(meanOf("silhouette_kept_at_50_" + shape, kept, 0));
            findings.push_back(meanOf("silhouette_kept_at_10_" + shape, keptAtTen, 0));
            findings.push_back(meanOf("silhouette_kept_at_110_" + shape, keptBeforeLast, 0));
        }
        const double late = kneeOfLateCurve();
        findings.push_back({"knee_of_late_curve", late, late - between / 2.0, late + between / 2.0, 1});
        return findings;
    };
    return info;
}

}  // namespace dustbench::voxel_shape::resolution
