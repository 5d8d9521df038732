#include "bench/measure/image/flaw_metrics.h"

#include <algorithm>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"

namespace dustbench::measure {
namespace {

bool isTrail(const Plane& reference, std::size_t i) {
    return reference.values[i] > trailAlpha;
}

bool isCovered(const Plane& alpha, const Plane& reference, std::size_t i) {
    return isTrail(reference, i) && alpha.values[i] >= reference.values[i] / 2;
}

/// Numbers the connected components of the pixels marked −1; specks become 0. Returns the number of components.
int numberParts(Plane& map) {
    int parts = 0;
    std::vector<std::pair<int, int>> members;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            if (map.at(x, y) != -1) continue;
            const auto number = static_cast<float>(parts + 1);
            members.assign(1, {x, y});
            map.at(x, y) = number;
            for (std::size_t next = 0; next < members.size(); ++next) {
                const auto [cx, cy] = members[next];
                for (int ny = std::max(cy - 1, 0); ny <= std::min(cy + 1, map.height - 1); ++ny)
                    for (int nx = std::max(cx - 1, 0); nx <= std::min(cx + 1, map.width - 1); ++nx)
                        if (map.at(nx, ny) == -1) {
                            map.at(nx, ny) = number;
                            members.emplace_back(nx, ny);
                        }
            }
            if (members.size() >= static_cast<std::size_t>(minimumPartPixels))
                ++parts;
            else
                for (const auto& [mx, my] : members) map.at(mx, my) = 0;
        }
    return parts;
}

}  // namespace

Measured gaps(const Plane& alpha, const Plane& referenceAlpha) {
    requireSameSize(alpha, "the alpha", referenceAlpha, "the reference's alpha");
    Measured result{{}, Plane(alpha.width, alpha.height)};
    std::size_t trail = 0, missing = 0;
    for (std::size_t i = 0; i < alpha.values.size(); ++i) {
        if (!isTrail(referenceAlpha, i)) continue;
        ++trail;
        if (isCovered(alpha, referenceAlpha, i)) continue;
        ++missing;
        result.map.values[i] = 1;
    }
    if (trail > 0) result.value = static_cast<double>(missing) / static_cast<double>(trail);
    return result;
}

Measured spill(const Plane& alpha, const Plane& referenceAlpha) {
    requireSameSize(alpha, "the alpha", referenceAlpha, "the reference's alpha");
    return gaps(referenceAlpha, alpha);
}

TrailParts components(const Plane& alpha, const Plane& referenceAlpha) {
    requireSameSize(alpha, "the alpha", referenceAlpha, "the reference's alpha");
    TrailParts result;
    result.map = Plane(alpha.width, alpha.height);
    Plane trail = result.map;
    bool any = false;
    for (std::size_t i = 0; i < alpha.values.size(); ++i) {
        any = any || isTrail(referenceAlpha, i);
        result.map.values[i] = isCovered(alpha, referenceAlpha, i) ? -1.0f : 0.0f;
        trail.values[i] = isTrail(referenceAlpha, i) ? -1.0f : 0.0f;
    }
    const int parts = numberParts(result.map), referenceParts = numberParts(trail);
    if (any) {
        result.parts = parts;
        result.referenceParts = referenceParts;
    }
    return result;
}

namespace trail_gaps_metric {

MetricGroup describe() {
    const auto ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
        const TrailParts trail = components(moment.alpha, moment.continuum);
        return {gaps(moment.alpha, moment.continuum).value, spill(moment.alpha, moment.continuum).value, trail.parts,
                trail.referenceParts};
    };
    return {.metrics = {{.column = "gaps",
                         .title = "share of the trail that is not covered",
                         .definition = "share of the trail (R > 0.1) where α < R/2",
                         .range = "0 … 1",
                         .unit = "share of the trail",
                         .emptyWhen = "no R > 0.1",
                         .perfect = "0",
                         .chartName = "gaps",
                         .isFlaw = true,
                         .needs = Needs::continuum,
                         .place = 15,
                         .round = 1},
                        {.column = "spill",
                         .title = "share of the method's trail with more than twice the reference's alpha",
                         .definition = "share of the method's own trail (α > 0.1) where α > 2R",
                         .range = "0 … 1",
                         .unit = "share of the shown trail",
                         .emptyWhen = "no α > 0.1",
                         .source = "Congalton1991",
                         .perfect = "0",
                         .chartName = "spill",
                         .isFlaw = true,
                         .needs = Needs::continuum,
                         .place = 16,
                         .round = 5},
                        {.column = "components",
                         .title = "number of separate parts of the trail",
                         .definition =
                             "parts of the trail where α ≥ R/2, connected by edges or corners, of at least 16 pixels",
                         .range = "0 …",
                         .unit = "parts",
                         .emptyWhen = "no R > 0.1",
                         .perfect = "as the reference",
                         .chartName = "parts of the trail",
                         .isFlaw = true,
                         .needs = Needs::continuum,
                         .place = 17,
                         .round = 1},
                        {.column = "components_reference",
                         .title = "number of separate parts of the reference's trail",
                         .definition =
                             "`components` of the continuum itself, since four wheels or a hill may divide the trail",
                         .range = "0 …",
                         .unit = "parts",
                         .emptyWhen = "no R > 0.1",
                         .perfect = "any",
                         .needs = Needs::continuum,
                         .place = 18,
                         .round = 2}},
            .ofMoment = ofMoment};
}

}  // namespace trail_gaps_metric

}  // namespace dustbench::measure
