#include "methods/relief/ageing_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "methods/kit/findings/findings.h"
#include "methods/kit/maths/philox.h"
#include "methods/relief/ageing_cost.h"

namespace dustbench::relief::ageing {
namespace {

using findings::meanOf;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::string cellName(const char* search, const CostCell& cell) {
    return fmt::format("{}_ms_{}_{}", search, cell.hits, cell.side);
}

/// The time of each cell, or why it was skipped.
void addTimes(const char* search, const std::vector<CostCell>& cells, std::vector<Finding>& findings) {
    for (const CostCell& cell : cells) {
        std::vector<double> milliseconds = cell.seconds;
        for (double& time : milliseconds) time *= 1e3;
        if (!milliseconds.empty()) {
            findings.push_back(meanOf(cellName(search, cell), milliseconds));
            continue;
        }
        findings.push_back({cellName(search, cell), missing, missing, missing, 0,
                            fmt::format("skipped: {} hits on {}² texels are {:.3g} tests, more than {:.0e}", cell.hits,
                                        cell.side, cell.tests(), maximumTests)});
    }
}

/// The two exponents of a search, over all cells that were measured.
void addExponents(const std::string& search, const std::vector<CostCell>& cells, int rounds,
                  std::vector<Finding>& findings) {
    std::vector<double> overHits, overTexels;
    for (std::size_t round = 0; round < static_cast<std::size_t>(rounds); ++round) {
        const Exponents exponents = exponentsOf(cells, round);
        overHits.push_back(exponents.overHits);
        overTexels.push_back(exponents.overTexels);
    }
    const auto skipped = std::ranges::count_if(cells, [](const CostCell& cell) { return cell.seconds.empty(); });
    for (const auto& [name, values] : {std::pair("_over_hits", overHits), {"_over_texels", overTexels}}) {
        findings.push_back(meanOf(search + name, values));
        if (skipped > 0)
            findings.back().note =
                fmt::format("{} of {} cells were skipped: more than {:.0e} tests", skipped, cells.size(), maximumTests);
    }
}

/// R25: what both searches cost over hits and texels.
void addGrowth(const CostSweep& sweep, std::vector<Finding>& findings) {
    CostSweep each = sweep;
    for (const auto& [name, search] : {std::pair("gather", Search::gather), {"scatter", Search::scatter}}) {
        each.search = search;
        const std::vector<CostCell> cells = measureCost(each);
        addExponents(name, cells, sweep.rounds, findings);
        addTimes(name, cells, findings);
    }
    each.reach = 16;
    addExponents("scatter_in_a_corner", measureCost(each), sweep.rounds, findings);
}

Finding crossover(std::uint64_t seed) {
    CostSweep sweep{Search::gather, {1, 2, 4, 8, 16, 32, 64}, {1000}, seed};
    const std::vector<CostCell> gather = measureCost(sweep);
    sweep.search = Search::scatter;
    const std::vector<CostCell> scatter = measureCost(sweep);
    std::vector<double> logarithms;
    for (std::size_t round = 0; round < static_cast<std::size_t>(sweep.rounds); ++round)
        logarithms.push_back(std::log(crossoverTexels(gather, scatter, round)));
    Finding finding = meanOf("crossover_texels", logarithms);
    if (std::isfinite(finding.value))
        for (double* number : {&finding.value, &finding.low, &finding.high}) *number = std::exp(*number);
    else
        finding = {
            finding.quantity,
            missing,
            missing,
            missing,
            sweep.rounds,
            fmt::format("{} takes longer on each surface from 1 to 64² texels",
                        gather.front().seconds.front() > scatter.front().seconds.front() ? "gather" : "scatter")};
    return finding;
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
    std::vector<Impact> impacts;
    for (int n = 0; n < hits; ++n) {
        const auto random = maths::uniform4(seed, 1, static_cast<std::uint64_t>(n));
        impacts.push_back({random[0] * float{side} - 0.5f, random[1] * float{side} - 0.5f, 0, DepthMap::bottom});
    }
    surface.scatter(impacts);
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

CostSweep shortSweep(std::uint64_t seed) {
    return {.sides = {64, 128, 256}, .hits = {512, 2048, 8192}, .seed = seed};
}

CostSweep wholeSweep(std::uint64_t seed) {
    return {.sides = {256, 512, 1024, 2048, 4096}, .hits = {1000, 10'000, 100'000, 1'000'000}, .seed = seed};
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary =
        "Measures how the cost of ageing a relief grows with hits and texels, and what a hit does to its texture.";
    info.source = "Bergeron";
    info.run = [](ExperimentContext& context) {
        std::vector<Finding> findings;
        addGrowth(context.quick() ? shortSweep(context.seed()) : wholeSweep(context.seed()), findings);
        findings.push_back(crossover(context.seed()));
        findings.push_back(loweredGreen("green_lowered", {0, -9.8f, 0}, context.seed()));
        findings.push_back(loweredGreen("green_lowered_without_gravity", glm::vec3(0), context.seed()));
        for (const Finding& finding : hitTexels(context.seed())) findings.push_back(finding);
        return findings;
    };
    return info;
}

}  // namespace dustbench::relief::ageing
