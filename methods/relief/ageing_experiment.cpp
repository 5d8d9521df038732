#include "methods/relief/ageing_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "methods/kit/findings/findings.h"
#include "methods/kit/findings/timing.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::relief::ageing {
namespace {

constexpr double enoughSeconds = 2e-3;  // per round, so that the clock's resolution does not matter

std::vector<Impact> randomImpacts(const CostSweep& sweep, int side, int hits, int round) {
    const auto within = static_cast<float>(std::min(side, sweep.reach));
    std::vector<Impact> impacts;
    impacts.reserve(static_cast<std::size_t>(hits));
    for (int n = 0; n < hits; ++n) {
        const auto random =
            maths::uniform4(sweep.seed + static_cast<std::uint64_t>(round), 1, static_cast<std::uint64_t>(n));
        impacts.push_back({random[0] * within - 0.5f, random[1] * within - 0.5f, 0, DepthMap::bottom / 1000});
    }
    return impacts;
}

/// The minimum over several calls if they are short.
double secondsToAge(WornSurface& surface, Search search, const std::vector<Impact>& impacts) {
    double shortest = std::numeric_limits<double>::infinity(), total = 0;
    while (total < enoughSeconds) {
        const double took =
            findings::secondsOf([&] { search == Search::gather ? surface.gather(impacts) : surface.scatter(impacts); });
        surface.takeOff();
        shortest = std::min(shortest, took);
        total += std::max(took, enoughSeconds / 100);
    }
    return shortest;
}

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
                fmt::format("{} of {} cases were skipped: more than {:.0e} tests", skipped, cells.size(), maximumTests);
    }
}

/// R25: the cost of both searches over hits and texels.
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

/// R25: the time of ageing per frame, over the number of hits, on a relief of 512² texels.
void addFrameTimes(std::uint64_t seed, std::vector<Finding>& findings) {
    constexpr int side = 512;
    const auto add = [&](const std::string& name, const CostSweep& sweep) {
        for (const CostCell& cell : measureCost(sweep)) {
            std::vector<double> milliseconds;
            milliseconds.reserve(cell.seconds.size());
            for (const double seconds : cell.seconds) milliseconds.push_back(1e3 * seconds);
            findings.push_back(meanOf(fmt::format("{}_ms_{}", name, cell.hits), milliseconds));
        }
    };
    add("frame", {Search::gather, {side}, {100, 1000, 10'000}, seed});
    add("frame", {.search = Search::gather, .sides = {side}, .hits = {100'000}, .seed = seed, .rounds = 2});
    add("scattered_frame", {Search::scatter, {side}, {1000}, seed});
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

/// R24: how often y decreases in a step of the paper's law, in the position and in the velocity texture, for particles
/// without initial vertical velocity.
std::vector<Finding> loweredGreen(const std::string& suffix, const glm::vec3& gravity, std::uint64_t seed) {
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
    std::vector<glm::vec2> before(count, glm::vec2(0));  // y of position and velocity
    glm::dvec2 lowered(0);
    for (int step = 0; step < steps; ++step) {
        particles.step(surface, {.law = MotionLaw::paper, .gravity = gravity});
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const glm::vec2 now(particles.places()[i].y, particles.velocities()[i].y);
            lowered += glm::dvec2(glm::lessThan(now, before[i]));
            before[i] = now;
        }
    }
    const glm::dvec2 share = lowered / double{count * steps};
    return {{"green_lowered" + suffix, share.x, share.x, share.x, std::int64_t{count} * steps},
            {"velocity_green_lowered" + suffix, share.y, share.y, share.y, std::int64_t{count} * steps}};
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

scene::Relief flatRelief(int side) {
    scene::Relief relief{side, side, {}, {}};
    relief.depth.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.5f);
    return relief;
}

std::vector<CostCell> measureCost(const CostSweep& sweep) {
    std::vector<CostCell> cells;
    for (const int side : sweep.sides) {
        MemoryLedger ledger;
        WornSurface surface(flatRelief(side), ledger);
        for (const int hits : sweep.hits) {
            CostCell& cell = cells.emplace_back(CostCell{side, hits, {}});
            if (sweep.search == Search::gather && cell.tests() > maximumTests) continue;
            for (int round = 0; round < sweep.rounds; ++round)
                cell.seconds.push_back(secondsToAge(surface, sweep.search, randomImpacts(sweep, side, hits, round)));
        }
    }
    return cells;
}

Exponents exponentsOf(const std::vector<CostCell>& cells, std::size_t round) {
    std::vector<glm::dvec3> points;  // logarithms of hits, texels and seconds
    glm::dvec3 mean(0);
    for (const CostCell& cell : cells)
        if (!cell.seconds.empty())
            points.emplace_back(std::log(cell.hits), std::log(cell.texels()), std::log(cell.seconds.at(round)));
    for (const glm::dvec3& point : points) mean += point / static_cast<double>(points.size());
    double hh = 0, tt = 0, ht = 0, hs = 0, ts = 0;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 off = point - mean;
        hh += off.x * off.x, tt += off.y * off.y, ht += off.x * off.y;
        hs += off.x * off.z, ts += off.y * off.z;
    }
    const double determinant = hh * tt - ht * ht;
    return {(hs * tt - ts * ht) / determinant, (ts * hh - hs * ht) / determinant};
}

double crossoverTexels(const std::vector<CostCell>& gather, const std::vector<CostCell>& scatter, std::size_t round) {
    const auto lead = [&](std::size_t i) {
        return std::log(gather[i].seconds.at(round) / scatter[i].seconds.at(round));
    };
    for (std::size_t i = 1; i < gather.size(); ++i) {
        const double before = lead(i - 1), after = lead(i);
        if (before < 0 && after >= 0)
            return gather[i - 1].texels() *
                   std::pow(gather[i].texels() / gather[i - 1].texels(), before / (before - after));
    }
    return std::numeric_limits<double>::quiet_NaN();
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary =
        "Measures how the cost of ageing a relief grows with hits and texels, and how a hit changes its texture.";
    info.source = "Bergeron";
    info.run = [](ExperimentContext& context) {
        std::vector<Finding> findings;
        addGrowth(context.quick() ? shortSweep(context.seed()) : wholeSweep(context.seed()), findings);
        addFrameTimes(context.seed(), findings);
        findings.push_back(crossover(context.seed()));
        for (const auto& [suffix, gravity] :
             {std::pair("", glm::vec3(0, -9.8f, 0)), {"_without_gravity", glm::vec3(0)}})
            for (const Finding& finding : loweredGreen(suffix, gravity, context.seed())) findings.push_back(finding);
        for (const Finding& finding : hitTexels(context.seed())) findings.push_back(finding);
        return findings;
    };
    return info;
}

}  // namespace dustbench::relief::ageing
