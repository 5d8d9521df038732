#include "methods/relief/legibility_experiment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/maths/philox.h"
#include "methods/relief/particles/relief_particles.h"
#include "methods/relief/relief_studio.h"

namespace dustbench::relief::legibility {
namespace {

using findings::meanOf;

constexpr int width = 400, height = 200;
constexpr int seeds = 5;
constexpr double threshold = 0.5;
constexpr double takenShare = 0.05;
constexpr double kilograms = 0.002, metresPerSecond = 5, hardness = 1e4;
constexpr std::int64_t lotSize = 10, maximumParticles = 2'000'000;  // of the smallest lot; in total
constexpr int windowRadius = 5;

std::array<double, 2 * windowRadius + 1> gaussian() {
    std::array<double, 2 * windowRadius + 1> weights{};
    double sum = 0;
    for (int k = -windowRadius; k <= windowRadius; ++k)
        sum += weights[static_cast<std::size_t>(k + windowRadius)] = std::exp(-k * k / (2 * 1.5 * 1.5));
    for (double& weight : weights) weight /= sum;
    return weights;
}

std::vector<double> lumaOf(const pictures::Image& image) {
    std::vector<double> luma;
    luma.reserve(image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) {
        glm::vec3 shown(0);
        for (int c = 0; c < 3; ++c) shown[c] = maths::encodeSrgb(std::clamp(pixel[c], 0.0f, 1.0f));
        luma.push_back(glm::dot(glm::dvec3(shown), glm::dvec3(0.2126, 0.7152, 0.0722)));
    }
    return luma;
}

/// Weighted sums along rows, or along columns, of the values within the window's radius; omits those at the rim.
std::vector<double> weighted(const std::vector<double>& values, int columns, int rows, bool alongRows) {
    static const auto weights = gaussian();
    const std::size_t reach = alongRows ? 1 : static_cast<std::size_t>(columns);
    const int across = alongRows ? columns - 2 * windowRadius : columns;
    const int down = alongRows ? rows : rows - 2 * windowRadius;
    std::vector<double> sums;
    if (across <= 0 || down <= 0) return sums;
    sums.reserve(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            const double* value = &values[static_cast<std::size_t>(y * columns + x)];
            double sum = 0;
            for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * value[k * reach];
            sums.push_back(sum);
        }
    return sums;
}

/// Weighted sums over the windows that are entirely within the picture.
std::vector<double> windowSums(const std::vector<double>& values, int columns) {
    const int rows = static_cast<int>(values.size()) / columns;
    return weighted(weighted(values, columns, rows, true), columns - 2 * windowRadius, rows, false);
}

/// Weighted sums over one window.
struct Moments {
    double r = 0, i = 0, rr = 0, ii = 0, ri = 0;

    [[nodiscard]] double similarity() const {
        constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
        return (2 * r * i + c1) * (2 * (ri - r * i) + c2) / ((r * r + i * i + c1) * (rr - r * r + ii - i * i + c2));
    }
};

/// Makes `count` particles hit the sign, starting with number `first`.
void hit(WornSurface& surface, const scene::Panel& panel, const AgeingSettings& ageing, std::uint64_t seed,
         std::int64_t first, std::int64_t count) {
    MemoryLedger ledger;
    ReliefParticles particles(panel, ledger);
    for (std::int64_t n = first; n < first + count; ++n) {
        const auto random = maths::uniform4(seed, 3, static_cast<std::uint64_t>(n));
        const glm::vec2 place = glm::vec2(panel.sizeMetres) * glm::vec2(random[0] - 0.5f, random[1] - 0.5f);
        particles.add({{place, 0}, {0, 0, -metresPerSecond}}, {}, static_cast<std::uint64_t>(n));
    }
    particles.step(surface.depths(), {.gravity = {0, 0, 0}, .stepSeconds = 1});
    std::vector<Impact> impacts;
    for (const SurfaceHit& each : particles.hits())
        impacts.push_back(impactOf(each, ageing, particles.texels(), panel.depthMetres));
    surface.scatter(impacts);
    surface.takeOff();
}

const scene::Panel& signOf(const scene::Scene& scene) {
    for (const scene::Panel& panel : scene.panels)
        if (panel.name == "sign") return panel;
    throw InputError("experiment legibility: the scene has no panel 'sign'");
}

std::vector<Finding> measured(ExperimentContext& context) {
    const auto world = context.world("relief_wall", {}, width, height);
    const scene::Panel& sign = signOf(world->scene());
    const AgeingSettings paper{.model = AgeingModel::paper};
    const AgeingSettings crater{.massKilograms = kilograms, .hardnessJoulesPerCubicMetre = hardness};
    const AgeingSettings soft{.massKilograms = kilograms, .hardnessJoulesPerCubicMetre = hardness / 2};
    std::vector<double> byPaper, byCrater, bySoft, ratios, ofEquals, ofVolume;
    for (std::uint64_t k = 0; k < seeds; ++k) {
        const auto until = [&](const AgeingSettings& ageing, std::uint64_t otherSeed = 0) {
            return particlesUntil(threshold, context.device(), world->scene(), sign, ageing,
                                  context.seed() + k + otherSeed);
        };
        byPaper.push_back(until(paper));
        byCrater.push_back(until(crater));
        bySoft.push_back(until(soft));
        ratios.push_back(byCrater.back() / bySoft.back());
        ofEquals.push_back(byCrater.back() / until(crater, seeds));
        const std::uint64_t seed = context.seed() + k;
        ofVolume.push_back(particlesUntilTaken(takenShare, sign, crater, seed) /
                           particlesUntilTaken(takenShare, sign, soft, seed));
    }
    return {meanOf("particles_paper", byPaper),           meanOf("particles_crater", byCrater),
            meanOf("particles_crater_soft", bySoft),      meanOf("hardness_ratio", ratios),
            meanOf("hardness_ratio_of_equals", ofEquals), meanOf("hardness_ratio_of_volume", ofVolume)};
}

}  // namespace

double similarity(const pictures::Image& reference, const pictures::Image& picture) {
    const std::vector<double> r = lumaOf(reference), i = lumaOf(picture);
    std::array<std::vector<double>, 5> products{r, i, r, i, r};
    for (std::size_t pixel = 0; pixel < r.size(); ++pixel) {
        products[2][pixel] *= r[pixel];
        products[3][pixel] *= i[pixel];
        products[4][pixel] *= i[pixel];
    }
    for (std::vector<double>& plane : products) plane = windowSums(plane, reference.width);
    double sum = 0;
    const std::size_t windows = products[0].size();
    for (std::size_t k = 0; k < windows; ++k)
        sum += Moments{products[0][k], products[1][k], products[2][k], products[3][k], products[4][k]}.similarity();
    return windows > 0 ? sum / static_cast<double>(windows) : 1;
}

double particlesUntil(double limit, gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel,
                      const AgeingSettings& ageing, std::uint64_t seed) {
    ReliefStyle style;
    style.whiteHits = ageing.model == AgeingModel::paper;
    ReliefStudio studio(device, scene, panel, style, viewOf(panel, 0, width, height));
    studio.draw();
    const pictures::Image fresh = studio.picture();
    std::int64_t count = 0;
    double before = 1;
    for (std::int64_t lot = lotSize; count < maximumParticles; lot = std::max(lotSize, count / 20)) {
        hit(studio.surface(), panel, ageing, seed, count, lot);
        studio.draw();
        const double now = similarity(fresh, studio.picture());
        if (now < limit) {
            const double share = (before - limit) / (before - now);
            const auto from = static_cast<double>(std::max<std::int64_t>(count, 1)),
                       to = static_cast<double>(count + lot);
            return from * std::pow(to / from, share);
        }
        before = now;
        count += lot;
    }
    return static_cast<double>(count);
}

double particlesUntilTaken(double share, const scene::Panel& panel, const AgeingSettings& ageing, std::uint64_t seed) {
    MemoryLedger ledger;
    WornSurface surface(*panel.relief, ledger);
    const double wanted = share * static_cast<double>(surface.initialVolume());
    double before = 0;
    for (std::int64_t count = 0; count < maximumParticles; count += lotSize) {
        hit(surface, panel, ageing, seed, count, lotSize);
        const auto taken = static_cast<double>(surface.takenOffVolume());
        if (taken >= wanted) return static_cast<double>(count) + lotSize * (wanted - before) / (taken - before);
        before = taken;
    }
    return static_cast<double>(maximumParticles);
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Counts the particles that make a sign illegible.";
    info.source = "Bergeron";
    info.run = measured;
    return info;
}

}  // namespace dustbench::relief::legibility
