#include "methods/relief/ageing_cost.h"

#include <algorithm>
#include <cmath>

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

}  // namespace dustbench::relief::ageing
