// For tests: a random cloud, drawn by the method, and its pixels by the plain moments and in the exact order.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/moment_oit/moment_oit.h"

namespace dustbench::moment_oit {

class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, bool oneColour, std::uint32_t seed = 1)
        : TestMoment(count, 48, 36, {0, 2, 0}, {0.1, -0.15, -1}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(oneColour);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.x[i] = 10 * uniform(random) - 5;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = -4 - 26 * uniform(random);
            dust.radius[i] = 0.4f + uniform(random);
            dust.opacity[i] = 0.5f * uniform(random);
            dust.lifetime[i] = 5;
            if (oneColour) continue;
            dust.red[i] = uniform(random), dust.green[i] = uniform(random), dust.blue[i] = uniform(random);
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    }
    void place(std::size_t i, const glm::vec3& at, float radius, float opacity, const glm::vec3& colour) {
        dust.x[i] = at.x, dust.y[i] = at.y, dust.z[i] = at.z;
        dust.radius[i] = radius, dust.opacity[i] = opacity;
        dust.red[i] = colour.r, dust.green[i] = colour.g, dust.blue[i] = colour.b;
    }
    pictures::Image drawn(Settings settings) {
        settings.reachDeviations = 6;  // cuts off nothing
        MomentOit method(settings);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
    [[nodiscard]] std::vector<RayPuff> along(const glm::dvec3& ray, double sceneMetres) const {
        std::vector<RayPuff> puffs;
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
            const double s = maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
            const double b = glm::length(glm::cross(centre, ray));
            puffs.push_back(
                {maths::puffOpticalDepth(static_cast<double>(dust.opacity[i])) * std::exp(-b * b / (2 * s * s)),
                 glm::dot(centre, ray), s, 0, sceneMetres});
        }
        return puffs;
    }
    /// Along the ray, in metres. The ground is set before.
    [[nodiscard]] double sceneAt(int x, int y, const glm::dvec3& ray) {
        if (depths_.empty()) depths_ = layer().sceneDepth().readFloats();
        const float reversed = depths_[static_cast<std::size_t>((view.height - 1 - y) * view.width + x)];
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        return reversed > 0 ? view.camera.nearMetres / static_cast<double>(reversed) / glm::dot(ray, ahead) : 1e9;
    }
    /// A pixel's colour by the plain moments.
    glm::dvec4 plainPixel(int x, int y, const Settings& settings) {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const WarpedDepth range = depthRange(dust, view, settings.warp, settings.puff);
        std::vector<Contribution> all;
        std::vector<double> b(static_cast<std::size_t>(settings.kind.count) + 1);
        for (const RayPuff& puff : along(ray, sceneAt(x, y, ray))) {
            all.push_back(contributionOf(puff, all.size(), ray, range, settings));
            addTo(b, all.back().moments, settings.kind);
        }
        if (b[0] < 1e-6) return glm::dvec4(0);
        glm::dvec3 colours(0);
        double weights = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Contribution& one = all[i];
            const auto at = [&](double metres) {
                return transmittance(b, range.at(std::max(metres, 0.001)), settings.kind,
                                     settings.biasFactor * biasOf(settings.kind), settings.overestimation);
            };
            double mean = at(one.metres);
            if (settings.samples == 3 && settings.puff == Puff::volume)
                mean = (4 * mean + at(one.metres - one.apartMetres) + at(one.metres + one.apartMetres)) / 6;
            colours += one.weight * mean * glm::dvec3(dust.colour(i));
            weights += one.weight * mean;
        }
        return {colours / weights * -std::expm1(-b[0]), -std::expm1(-b[0])};
    }
    /// By the exact order of the surfaces along the ray.
    glm::dvec4 sortedSurfaces(int x, int y) {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const Settings settings{.puff = Puff::surface};
        const WarpedDepth range = depthRange(dust, view, settings.warp, settings.puff);
        std::vector<std::pair<Contribution, glm::dvec3>> all;
        for (const RayPuff& puff : along(ray, sceneAt(x, y, ray))) {
            const std::size_t i = all.size();
            all.emplace_back(contributionOf(puff, i, ray, range, settings), dust.colour(i));
        }
        std::ranges::sort(all, {}, [](const auto& one) { return one.first.metres; });
        glm::dvec3 over(0);
        double left = 1;
        for (const auto& [one, colour] : all) {
            over += left * one.weight * colour;
            left *= 1 - one.weight;
        }
        return {over, 1 - left};
    }

 private:
    struct Contribution {
        std::vector<double> moments;
        double metres, apartMetres, weight;
    };
    [[nodiscard]] Contribution contributionOf(const RayPuff& puff, std::size_t i, const glm::dvec3& ray,
                                              const WarpedDepth& range, const Settings& settings) const {
        if (settings.puff == Puff::surface) {
            const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
            const double metres = glm::dot(glm::dvec3(dust.position(i)) - view.camera.eye, ahead);
            const bool seen = metres >= view.camera.nearMetres && metres <= puff.endMetres * glm::dot(ray, ahead);
            const double depth = seen ? puff.whole : 0;
            return {momentsOf(RaySurface{depth, std::max(metres, 0.001)}, range, settings.kind), metres, 0,
                    -std::expm1(-depth)};
        }
        const Profile profile = profileOf(puff);
        const bool isPoint = settings.shape == Shape::point;
        return {isPoint
                    ? momentsOf(RaySurface{profile.depth, std::max(profile.meanMetres, 0.001)}, range, settings.kind)
                    : momentsOf(puff, range, settings.kind),
                profile.meanMetres, std::sqrt(3 * profile.varianceSquareMetres),
                isPoint ? -std::expm1(-profile.depth) : profile.depth};
    }
    /// In 16 bits, the sum so far is rounded after each puff.
    static void addTo(std::vector<double>& b, const std::vector<double>& one, const Kind& kind) {
        if (kind.precision == Precision::quantised && one[0] < 1e-7) return;
        for (std::size_t j = 0; j < b.size(); ++j) b[j] += one[j];
        if (kind.precision == Precision::single) return;
        std::vector<double> normalised;
        for (std::size_t j = 1; j < b.size(); ++j) normalised.push_back(b[j] / b[0]);
        std::vector<double> stored = quantised(kind, normalised);
        for (double& number : stored) number = std::round(std::clamp(number, 0.0, 1.0) * 65535) / 65535;
        const std::vector<double> rounded = dequantised(kind, stored);
        for (std::size_t j = 1; j < b.size(); ++j) b[j] = rounded[j - 1] * b[0];
    }
    std::vector<float> depths_;
};

inline std::vector<Kind> allKinds() {
    std::vector<Kind> all;
    for (const Basis basis : {Basis::power, Basis::trigonometric})
        for (const Precision precision : {Precision::single, Precision::quantised})
            for (const int count : {4, 6, 8}) all.push_back({basis, precision, count});
    return all;
}

inline std::string nameOf(const Kind& kind) {
    return std::string(bases.wordOf(kind.basis)) + ' ' + std::string(precisions.wordOf(kind.precision)) + ' ' +
           std::to_string(kind.count);
}

}  // namespace dustbench::moment_oit
