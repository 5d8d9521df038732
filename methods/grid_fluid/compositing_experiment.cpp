#include "methods/grid_fluid/compositing_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/raycast/plain_march.h"

namespace dustbench::grid_fluid::compositing {
namespace {

constexpr int edgeCells = 24;
constexpr double edgeMetres = 0.1;

struct LumpyCloud {
    std::vector<float> density = std::vector<float>(edgeCells * edgeCells * edgeCells);
    std::vector<float> reaction = density;

    [[nodiscard]] raycast::ShownGrid shown() const {
        return {glm::ivec3(edgeCells), edgeMetres, glm::dvec3(-edgeCells * edgeMetres / 2), density, reaction};
    }
};

/// A lumpy ball, clear at the grid's rim, hotter on one side.
LumpyCloud lumpyCloud(std::uint64_t seed) {
    const auto random = maths::uniform4(seed, 5, 0);
    const glm::dvec3 phase = 6.0 * glm::dvec3(random[0], random[1], random[2]);
    LumpyCloud cloud;
    std::size_t i = 0;
    for (int z = 0; z < edgeCells; ++z)
        for (int y = 0; y < edgeCells; ++y)
            for (int x = 0; x < edgeCells; ++x, ++i) {
                const glm::dvec3 at = 2.0 * (glm::dvec3(x, y, z) + 0.5) / double{edgeCells} - 1.0;
                const glm::dvec3 waves = glm::sin(7.0 * at + phase);
                const double ball = std::max(0.0, 1 - glm::dot(at, at) / 0.8);
                cloud.density[i] = static_cast<float>(ball * (1 + 0.8 * waves.x * waves.y * waves.z));
                cloud.reaction[i] = static_cast<float>(std::clamp(0.5 + 0.5 * waves.y + at.z, 0.0, 1.0));
            }
    return cloud;
}

raycast::RaycastSettings cloudSettings(double depthThroughMiddle) {
    raycast::RaycastSettings settings;
    settings.jitter = false;
    settings.stopAlpha = 1;
    // ∫ (1 − r²/0.8) dr over the ball's diameter is 1.19 half edges.
    settings.extinctionPerMetre = depthThroughMiddle / (1.19 * edgeCells * edgeMetres / 2);
    return settings;
}

/// The samples of rays that fill a picture of `across`² pixels, along −z.
std::vector<std::vector<Sample>> samplesOf(const LumpyCloud& cloud, double depth, int across) {
    raycast::PlainVolume volume;
    volume.grid = cloud.shown();
    volume.settings = cloudSettings(depth);
    volume.reflected = raycast::cloudColour(glm::vec3(0.4f), scene::Lights());
    std::vector<std::vector<Sample>> rays;
    for (int y = 0; y < across; ++y)
        for (int x = 0; x < across; ++x) {
            const glm::dvec2 place = double{edgeCells} * (glm::dvec2(x, y) + 0.5) / double(across);
            std::vector<Sample>& ray = rays.emplace_back();
            for (const raycast::PlainStep& step :
                 raycast::plainSteps(volume, {{place, edgeCells + 1.0}, {0, 0, -1}, 1e9, 0.5}))
                ray.push_back({glm::vec3(step.source), static_cast<float>(-std::expm1(-step.depth))});
        }
    return rays;
}

double largestDifference(const glm::vec4& a, const glm::vec4& b) {
    double largest = 0;
    for (int channel = 0; channel < 4; ++channel)
        largest = std::max(largest, std::abs(static_cast<double>(a[channel]) - static_cast<double>(b[channel])));
    return largest;
}

/// OpenGL's march and slices, at the few pixels whose rays are so close to the axis that both sample the same points.
double marchAgainstSlices(gpu::Device& device, std::uint64_t seed) {
    constexpr int across = 4, views = 12;
    const LumpyCloud cloud = lumpyCloud(seed);
    gpu::Texture depth = gpu::Texture::make2D(device, "compositing: depth", gpu::Format::depth32F, across, across);
    depth.write(std::span<const float>(std::vector<float>(across * across)));
    gpu::Layer layer(device, depth);
    double largest = 0;
    for (std::uint64_t n = 0; n < views; ++n) {
        const auto random = maths::uniform4(seed, 6, n);
        scene::View view;
        view.width = view.height = across;
        view.camera.verticalFieldOfView = 1e-3;
        view.camera.eye = 3.0 * glm::normalize(glm::dvec3(maths::centred(random[0]), maths::centred(random[1]),
                                                          maths::centred(random[2])) +
                                               1e-3);
        view.camera.target = glm::dvec3(0.2 * static_cast<double>(maths::centred(random[3])));
        const auto pictureBy = [&](raycast::Renderer renderer) {
            raycast::RaycastSettings settings = cloudSettings(10);
            settings.backend = raycast::Backend::gl;
            settings.renderer = renderer;
            MemoryLedger ledger;
            raycast::GridRaycast raycast(device, settings, scene::Lights(), ledger);
            raycast.upload(cloud.shown());
            layer.clear();
            raycast.draw(view, layer);
            return draw::readBack(layer.colour());
        };
        const pictures::Image front = pictureBy(raycast::Renderer::raycast),
                              back = pictureBy(raycast::Renderer::slices);
        for (std::size_t i = 0; i < front.pixels.size(); ++i)
            largest = std::max(largest, largestDifference(front.pixels[i], back.pixels[i]));
    }
    return largest;
}

}  // namespace

Composite frontToBack(std::span<const Sample> samples, float stopAlpha) {
    Composite composite;
    glm::vec3 colour(0);
    float alpha = 0;
    for (const Sample& sample : samples) {
        ++composite.samples;
        const float share = sample.opacity * (1 - alpha);
        colour += share * sample.colour;
        alpha += share;
        if (alpha > stopAlpha) break;
    }
    composite.seen = {colour, alpha};
    return composite;
}

Composite backToFront(std::span<const Sample> samples) {
    Composite composite;
    for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
        ++composite.samples;
        composite.seen = sample->opacity * glm::vec4(sample->colour, 1) + (1 - sample->opacity) * composite.seen;
    }
    return composite;
}

namespace {

std::vector<Finding> measureOrders(ExperimentContext& context) {
    constexpr std::array depths{2, 5, 10, 20, 40};
    constexpr float stopAlpha = 0.99f;
    const int across = context.quick() ? 24 : 64;
    const std::uint64_t clouds = context.quick() ? 5 : 12, first = 1000 * context.seed();
    std::vector<Finding> all;
    const auto add = [&](const std::string& quantity, const std::vector<double>& ofClouds) {
        const auto [low, high] = std::ranges::minmax_element(ofClouds);
        all.push_back({quantity, *high, *low, *high, static_cast<std::int64_t>(ofClouds.size()) * across * across});
    };
    std::vector<double> formulas, wrong, byGl;
    for (std::uint64_t cloud = first; cloud < first + clouds; ++cloud) {
        double apart = 0, wrongly = 0;
        for (std::vector<Sample>& ray : samplesOf(lumpyCloud(cloud), 10, across)) {
            const glm::vec4 fromFront = frontToBack(ray, 1).seen;
            apart = std::max(apart, largestDifference(fromFront, backToFront(ray).seen));
            std::ranges::reverse(ray);
            wrongly = std::max(wrongly, largestDifference(fromFront, backToFront(ray).seen));
        }
        formulas.push_back(apart);
        wrong.push_back(wrongly);
        byGl.push_back(marchAgainstSlices(context.device(), cloud));
    }
    add("orders_formulas", formulas);
    add("orders_wrong", wrong);
    add("orders_gl", byGl);
    for (const int depth : depths) {
        std::vector<double> saved, stopped;
        for (std::uint64_t cloud = first; cloud < first + clouds; ++cloud) {
            const std::vector<std::vector<Sample>> rays = samplesOf(lumpyCloud(cloud), depth, across);
            double most = 0, taken = 0, whole = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Composite full = frontToBack(rays[i], 1), ended = frontToBack(rays[i], stopAlpha);
                most = std::max(most, largestDifference(full.seen, ended.seen));
                // Only the rays of the central ninth.
                const glm::ivec2 pixel(static_cast<int>(i) % across, static_cast<int>(i) / across);
                if (glm::any(glm::lessThan(3 * pixel, glm::ivec2(across))) ||
                    glm::any(glm::greaterThanEqual(3 * pixel, glm::ivec2(2 * across))))
                    continue;
                taken += ended.samples;
                whole += full.samples;
            }
            saved.push_back(1 - taken / whole);
            stopped.push_back(most);
        }
        all.push_back(findings::meanOf("saved_" + std::to_string(depth), saved));
        add("stopped_" + std::to_string(depth), stopped);
    }
    return all;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary =
        "Compares front-to-back with back-to-front compositing of rays, and measures what early termination saves.";
    info.source = "Senger2009";
    info.run = measureOrders;
    return info;
}

}  // namespace dustbench::grid_fluid::compositing
