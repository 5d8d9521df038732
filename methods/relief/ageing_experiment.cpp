#include "methods/relief/ageing_experiment.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "methods/kit/maths/philox.h"

namespace dustbench::relief::ageing {
namespace {

constexpr int rounds = 7;
constexpr double studentOfSix = 2.447;  // t(0.975; rounds − 1)

scene::Relief flatRelief(int side) {
    scene::Relief relief{side, side, {}, {}};
    relief.depth.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.5f);
    return relief;
}

std::vector<Impact> randomImpacts(int side, int hits, std::uint64_t seed, std::uint32_t depth) {
    std::vector<Impact> impacts;
    impacts.reserve(static_cast<std::size_t>(hits));
    for (int n = 0; n < hits; ++n) {
        const auto random = maths::uniform4(seed, 1, static_cast<std::uint64_t>(n));
        impacts.push_back(
            {random[0] * static_cast<float>(side) - 0.5f, random[1] * static_cast<float>(side) - 0.5f, 0, depth});
    }
    return impacts;
}

/// Returns the exponents of several rounds as a finding: their mean and its 95 % interval.
Finding findingOf(const char* quantity, const std::vector<double>& exponents) {
    double mean = 0, squares = 0;
    for (const double exponent : exponents) mean += exponent / rounds;
    for (const double exponent : exponents) squares += (exponent - mean) * (exponent - mean);
    const double half = studentOfSix * std::sqrt(squares / (rounds - 1) / rounds);
    return {quantity, mean, mean - half, mean + half, rounds};
}

Finding growth(const char* quantity, Search search, bool overTexels, std::uint64_t seed) {
    const std::vector<int> sides = overTexels ? std::vector<int>{64, 128, 256} : std::vector<int>{96};
    const std::vector<int> counts = overTexels ? std::vector<int>{96} : std::vector<int>{128, 512, 2048};
    std::vector<double> exponents;
    for (int round = 0; round < rounds; ++round) {
        std::vector<double> sizes, seconds;
        for (const int side : sides)
            for (const int hits : counts) {
                sizes.push_back(overTexels ? static_cast<double>(side) * side : hits);
                seconds.push_back(ageingSeconds(search, side, hits, seed + static_cast<std::uint64_t>(round), 3));
            }
        exponents.push_back(growthExponent(sizes, seconds));
    }
    return findingOf(quantity, exponents);
}

/// R24: how often y decreases in a step of the paper's law, for particles without initial vertical velocity.
Finding loweredGreen(const std::string& quantity, const glm::vec3& gravity, std::uint64_t seed) {
    constexpr int count = 1000, steps = 5;
    scene::Panel panel;  // large enough that no particle leaves it
    panel.sizeMetres = glm::dvec2(1e4);
    panel.depthMetres = 1e4;
    auto relief = std::make_shared<scene::Relief>(flatRelief(2));
    relief->depth.assign(4, 1.0f);
    panel.relief = relief;
    MemoryLedger ledger;
    const DepthMap surface(*relief, ledger);
    ReliefParticles particles(panel, ledger);
    for (int n = 0; n < count; ++n) {
        const auto random = maths::uniform4(seed, 2, static_cast<std::uint64_t>(n));
        particles.add({{random[0], 0, -5000}, {maths::centred(random[1]), 0, maths::centred(random[2])}}, {},
                      static_cast<std::uint64_t>(n));
    }
    std::vector<float> before(count, 0.0f);
    std::int64_t lowered = 0;
    for (int step = 0; step < steps; ++step) {
        particles.step(surface, {.law = MotionLaw::paper, .gravity = gravity});
        for (std::size_t i = 0; i < particles.size(); ++i) {
            lowered += particles.places()[i].y < before[i] ? 1 : 0;
            before[i] = particles.places()[i].y;
        }
    }
    const double share = static_cast<double>(lowered) / (count * steps);
    return {quantity, share, share, share, std::int64_t{count} * steps};
}

/// R24: under the paper's ageing a hit texel's depth, the α of its texture, is 1, and no other texel changes.
std::vector<Finding> hitTexels(std::uint64_t seed) {
    constexpr int side = 128, hits = 1000;
    MemoryLedger ledger;
    WornSurface surface(flatRelief(side), ledger);
    surface.scatter(randomImpacts(side, hits, seed, DepthMap::bottom));
    surface.takeOff();
    std::int64_t hit = 0, atBottom = 0, changed = 0;
    for (std::size_t i = 0; i < surface.depths().size(); ++i) {
        const std::uint32_t depth = surface.depths().depths()[i];
        hit += surface.hits()[i] > 0 ? 1 : 0;
        atBottom += surface.hits()[i] > 0 && depth == DepthMap::bottom ? 1 : 0;
        changed += surface.hits()[i] == 0 && depth != DepthMap::bottom / 2 ? 1 : 0;
    }
    const auto others = static_cast<std::int64_t>(surface.depths().size()) - hit;
    const double bottomShare = static_cast<double>(atBottom) / static_cast<double>(hit);
    const double changedShare = static_cast<double>(changed) / static_cast<double>(others);
    return {{"hit_texels_at_bottom", bottomShare, bottomShare, bottomShare, hit},
            {"other_texels_changed", changedShare, changedShare, changedShare, others}};
}

}  // namespace

double ageingSeconds(Search search, int side, int hits, std::uint64_t seed, int repetitions) {
    const std::vector<Impact> impacts = randomImpacts(side, hits, seed, DepthMap::bottom / 1000);
    MemoryLedger ledger;
    WornSurface surface(flatRelief(side), ledger);
    double shortest = std::numeric_limits<double>::infinity();
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        const auto begin = std::chrono::steady_clock::now();
        search == Search::gather ? surface.gather(impacts) : surface.scatter(impacts);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        surface.takeOff();
        shortest = std::min(shortest, took.count());
    }
    return shortest;
}

double growthExponent(const std::vector<double>& sizes, const std::vector<double>& seconds) {
    const auto n = static_cast<double>(sizes.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const double a = std::log(sizes[i]), b = std::log(seconds[i]);
        x += a / n, y += b / n;
        xx += a * a / n, xy += a * b / n;
    }
    return (xy - x * y) / (xx - x * x);
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary =
        "Measures how the cost of ageing a relief grows with hits and texels, and what a hit does to its texture.";
    info.source = "Bergeron";
    info.run = [](ExperimentContext& context) {
        std::vector<Finding> findings{growth("gather_over_hits", Search::gather, false, context.seed()),
                                      growth("gather_over_texels", Search::gather, true, context.seed()),
                                      growth("scatter_over_hits", Search::scatter, false, context.seed()),
                                      growth("scatter_over_texels", Search::scatter, true, context.seed())};
        findings.push_back(loweredGreen("green_lowered", {0, -9.8f, 0}, context.seed()));
        findings.push_back(loweredGreen("green_lowered_without_gravity", glm::vec3(0), context.seed()));
        for (const Finding& finding : hitTexels(context.seed())) findings.push_back(finding);
        return findings;
    };
    return info;
}

}  // namespace dustbench::relief::ageing
