#include "bench/reference/sun_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "methods/kit/maths/fast_functions.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::reference {
namespace {

constexpr double nodesPerDeviation = 4;

/// Weights of the nodes −1, 0, 1, 2 for a position `t` between 0 and 1: the cubic through all four.
std::array<float, 4> cubicWeights(float t) {
    const float a = t + 1, b = t - 1, c = t - 2;
    return {-t * b * c / 6, a * b * c / 2, -a * t * c / 2, a * t * b / 6};
}

/// exp(−(x − c)²/2s²) at the nodes from `first` on.
struct Profile {
    std::size_t first;
    std::vector<float> values;
};

/// Centre, standard deviation and reach along an axis, in cells from its origin.
struct Place {
    double centre, deviation, reach;

    [[nodiscard]] std::size_t first() const { return static_cast<std::size_t>(centre - reach); }
    [[nodiscard]] std::size_t last() const { return static_cast<std::size_t>(centre + reach); }
    [[nodiscard]] Profile profile() const {
        Profile profile{first(), {}};
        for (std::size_t k = first(); k <= last(); ++k) {
            const double away = (static_cast<double>(k) - centre) / deviation;
            profile.values.push_back(static_cast<float>(std::exp(-away * away / 2)));
        }
        return profile;
    }
    /// Share of the puff from node k to the next one; its tails go to the outermost nodes.
    [[nodiscard]] double between(std::size_t k) const {
        const maths::HalfErrorFunction& halfErf = maths::HalfErrorFunction::instance();
        const auto below = [&](std::size_t node) {
            return halfErf((static_cast<double>(node) - centre) / (std::numbers::sqrt2 * deviation));
        };
        return (k < last() ? below(k + 1) : 0.5) - (k > first() ? below(k) : -0.5);
    }
};

}  // namespace

std::optional<SunLattice::Octave> SunLattice::latticeOf(const std::vector<Entry>& puffs, double spacing,
                                                        std::size_t maximumNodes) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Entry& puff : puffs) {
        low = glm::min(low, puff.centre - puff.reach);
        high = glm::max(high, puff.centre + puff.reach);
    }
    // Two more nodes on each side, without depth across the sun's direction, as support of the cubics.
    const glm::dvec3 nodes = glm::ceil((high - low) / spacing) + 5.0;
    if (!(nodes.x * nodes.y * nodes.z <= static_cast<double>(maximumNodes))) return std::nullopt;
    return Octave{low - 2 * spacing, spacing, glm::ivec3(nodes), {}};
}

void SunLattice::fill(Octave& octave, const std::vector<Entry>& puffs) {
    const glm::ivec3 nodes = octave.nodes;
    const auto row = static_cast<std::size_t>(nodes.x), layer = row * static_cast<std::size_t>(nodes.y);
    octave.depths.assign(layer * static_cast<std::size_t>(nodes.z), 0.0f);
    std::vector<Place> along;
    std::vector<Profile> across, up;
    std::vector<std::vector<std::uint32_t>> ofLayer(static_cast<std::size_t>(nodes.z));
    for (const Entry& puff : puffs) {
        const glm::dvec3 centre = (puff.centre - octave.origin) / octave.spacing;
        const double deviation = puff.deviation / octave.spacing, reach = puff.reach / octave.spacing;
        across.push_back(Place{centre.x, deviation, reach}.profile());
        up.push_back(Place{centre.y, deviation, reach}.profile());
        along.push_back({centre.z, deviation, reach});
        for (std::size_t k = along.back().first(); k <= along.back().last(); ++k)
            ofLayer[k].push_back(static_cast<std::uint32_t>(along.size() - 1));
    }
    // First the depth between each layer and the next one towards the sun.
    parallel::forEachBlock(ofLayer.size(), 1, [&](std::size_t w, std::size_t) {
        for (const std::uint32_t i : ofLayer[w]) {
            const auto between = static_cast<float>(puffs[i].depth * along[i].between(w));
            const std::vector<float>& profile = across[i].values;
            float* to = octave.depths.data() + w * layer + up[i].first * row + across[i].first;
            for (const float share : up[i].values) {
                const float here = between * share;
                for (std::size_t x = 0; x < profile.size(); ++x) to[x] += here * profile[x];
                to += row;
            }
        }
    });
    // Then the sums, starting at the side of the sun.
    parallel::forEachBlock(static_cast<std::size_t>(nodes.y), 1, [&](std::size_t y, std::size_t) {
        for (std::size_t w = ofLayer.size() - 1; w-- > 0;) {
            float* const here = octave.depths.data() + w * layer + y * row;
            for (std::size_t x = 0; x < row; ++x) here[x] += here[layer + x];
        }
    });
}

double SunLattice::Octave::at(const glm::dvec3& place) const {
    glm::dvec3 where = (place - origin) / spacing;
    if (where.x <= 1 || where.y <= 1 || where.x >= nodes.x - 2 || where.y >= nodes.y - 2 || where.z >= nodes.z - 2)
        return 0;
    where.z = std::max(where.z, 1.0);  // behind all puffs the depth is constant
    const glm::ivec3 base(where);
    const auto u = cubicWeights(static_cast<float>(where.x - base.x)),
               v = cubicWeights(static_cast<float>(where.y - base.y)),
               w = cubicWeights(static_cast<float>(where.z - base.z));
    const auto row = static_cast<std::ptrdiff_t>(nodes.x), layer = row * nodes.y;
    const float* const from = depths.data() + (base.z - 1) * layer + (base.y - 1) * row + (base.x - 1);
    glm::vec4 sum(0);
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 4; ++j) {
            const float* const four = from + k * layer + j * row;
            sum += w[static_cast<std::size_t>(k)] * v[static_cast<std::size_t>(j)] *
                   glm::vec4(four[0], four[1], four[2], four[3]);
        }
    return static_cast<double>(glm::dot(sum, glm::vec4(u[0], u[1], u[2], u[3])));
}

SunLattice::SunLattice(const Puffs& store, const glm::dvec3& toSun, double opticalDepthShare, double neglected,
                       double spacingMetres, std::size_t maximumNodes)
    : toSunFrame_(glm::transpose(light::sunFrame(toSun))) {
    std::map<int, std::vector<Entry>> octaves;
    std::map<int, std::vector<std::uint32_t>> indices;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const double s = maths::puffDeviationMetres(static_cast<double>(store.radius[i]));
        const double depth = opticalDepthShare * maths::puffOpticalDepth(static_cast<double>(store.opacity[i]));
        if (!(s > 0) || !(depth > neglected)) continue;
        const int octave = std::ilogb(s);
        octaves[octave].push_back(
            {toSunFrame_ * glm::dvec3(store.position(i)), s, depth, s * std::sqrt(2 * std::log(depth / neglected))});
        indices[octave].push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<std::uint32_t> rest;
    for (const auto& [octave, puffs] : octaves) {
        const auto narrowest = std::ranges::min_element(puffs, {}, &Entry::deviation);
        auto lattice =
            latticeOf(puffs, std::min(narrowest->deviation / nodesPerDeviation, spacingMetres), maximumNodes);
        if (lattice)
            fill(octaves_.emplace_back(std::move(*lattice)), puffs);
        else
            rest.insert(rest.end(), indices[octave].begin(), indices[octave].end());
    }
    std::ranges::sort(rest);
    if (!rest.empty()) rest_.emplace(store, toSun, opticalDepthShare, neglected, rest);
}

double SunLattice::at(const glm::dvec3& position) const {
    const glm::dvec3 place = toSunFrame_ * position;
    double sum = rest_ ? rest_->at(position) : 0;
    for (const Octave& octave : octaves_) sum += octave.at(place);
    return std::max(sum, 0.0);
}

std::size_t SunLattice::nodes() const {
    std::size_t sum = 0;
    for (const Octave& octave : octaves_) sum += octave.depths.size();
    return sum;
}

}  // namespace dustbench::reference
