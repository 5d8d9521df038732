#include "methods/grid_fluid/fire_experiment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/raycast/grid_renderer.h"
#include "methods/kit/raycast/plain_march.h"

namespace dustbench::grid_fluid::fire {
namespace {

constexpr double widthMetres = 1.6;
constexpr double stepSeconds = 1.0 / 60;
constexpr double extinctionPerMetre = 6;
constexpr double burningPerSecond = 1.1;
constexpr double minimumAlpha = 1e-4;  ///< of a pixel: below it nothing is there

double spacingOf(int cells) {
    return widthMetres / cells;
}

/// The light that smoke reflects: a dark one's, in daylight.
raycast::Reflected smoke() {
    return raycast::cloudColour(glm::vec3(0.1f), scene::Lights{});
}

flow::FluidSource sourceOf(std::uint64_t seed) {
    const auto a = maths::uniform4(seed, 1, 0);
    flow::FluidSource source;
    source.centreMetres = {widthMetres * (0.5 + 0.1 * static_cast<double>(maths::centred(a[0]))), 0.3,
                           widthMetres * (0.5 + 0.1 * static_cast<double>(maths::centred(a[1])))};
    source.radiusMetres = 0.12 + 0.04 * static_cast<double>(a[2]);
    source.densityPerSecond = 6;
    source.kelvinPerSecond = 500 + 200 * a[3];
    source.reaction = 1;
    return source;
}

flow::FluidSettings settingsOf(int cells) {
    flow::FluidSettings settings;
    settings.box = {{cells, 2 * cells, cells}, spacingOf(cells), {0, 0, 0}};
    settings.sides = flow::closed;
    settings.advection = {flow::AdvectionScheme::macCormack, flow::Limit::revert};
    settings.forces.buoyancyPerKelvin = 0.03f;
    settings.forces.coolingPerSecond = 0.9f;
    settings.forces.reactionLossPerSecond = static_cast<float>(burningPerSecond);
    return settings;
}

/// Trilinear between the centres of the cells, constant beyond the outermost.
class Speeds {
 public:
    explicit Speeds(const flow::FluidSolver& solver)
        : cells_(solver.box().cells), spacing_(solver.box().spacingMetres), values_(3) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            values_[axis].resize(solver.box().cellCount());
            solver.gather(static_cast<flow::Lane>(flow::velocityX + axis), values_[axis]);
        }
    }

    [[nodiscard]] glm::dvec3 at(const glm::dvec3& place) const {
        const glm::dvec3 fromMiddle = glm::clamp(place / spacing_ - 0.5, glm::dvec3(0), glm::dvec3(cells_ - 1) - 1e-9);
        const glm::ivec3 low(fromMiddle);
        const glm::dvec3 t = fromMiddle - glm::dvec3(low);
        glm::dvec3 sum(0);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::dvec3 weights = glm::mix(1.0 - t, t, glm::dvec3(step));
            const glm::ivec3 at = low + step;
            const auto cell = static_cast<std::size_t>(at.x + cells_.x * (at.y + cells_.y * at.z));
            for (std::size_t axis = 0; axis < 3; ++axis)
                sum[static_cast<int>(axis)] +=
                    weights.x * weights.y * weights.z * static_cast<double>(values_[axis][cell]);
        }
        return sum;
    }

 private:
    glm::ivec3 cells_;
    double spacing_;
    std::vector<std::vector<float>> values_;
};

/// Two numbers of a normal distribution. Source: Box1958.
glm::dvec2 normalPair(float a, float b) {
    const double length = std::sqrt(-2 * std::log(1 - static_cast<double>(a)));
    const double angle = 2 * std::numbers::pi * static_cast<double>(b);
    return {length * std::cos(angle), length * std::sin(angle)};
}

glm::dvec3 birthPlace(const flow::FluidSource& source, std::uint64_t seed, std::uint64_t serial) {
    const auto a = maths::uniform4(seed, 2, serial);
    const glm::dvec2 across = normalPair(a[0], a[1]), along = normalPair(a[2], a[3]);
    return source.centreMetres + source.radiusMetres * glm::dvec3(across, along.x);
}

template <typename Colour>
Picture pictureByRays(int width, const Colour& colourOf) {
    Picture picture{width, 2 * width, {}, {}};
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(picture.height);
    picture.colours.resize(pixels);
    picture.alphas.resize(pixels);
    const double edge = widthMetres / width;
    parallel::forEachBlock(pixels, static_cast<std::size_t>(width), [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto x = static_cast<double>(i % static_cast<std::size_t>(width)),
                       y = static_cast<double>(i / static_cast<std::size_t>(width));
            const glm::dvec4 seen = colourOf(glm::dvec2(x + 0.5, y + 0.5) * edge);
            picture.colours[i] = glm::dvec3(seen);
            picture.alphas[i] = seen.a;
        }
    });
    return picture;
}

/// Rank of each value, ties sharing their mean.
std::vector<double> ranksOf(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
        for (std::size_t k = first; k <= last; ++k) ranks[order[k]] = static_cast<double>(first + last) / 2;
        first = last + 1;
    }
    return ranks;
}

double correlationOf(const std::vector<double>& a, const std::vector<double>& b) {
    const auto meanOf = [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    };
    const double meanA = meanOf(a), meanB = meanOf(b);
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - meanA) * (b[i] - meanB);
        aa += (a[i] - meanA) * (a[i] - meanA);
        bb += (b[i] - meanB) * (b[i] - meanB);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// `emissionOf(reaction)` in place of the flame's, with its extinction at `readAt(reaction)`.
template <typename Emission, typename Read>
raycast::TransferFunction changed(const raycast::TransferFunction& flame, const Emission& emissionOf,
                                  const Read& readAt) {
    constexpr int rows = 64;
    std::vector<raycast::TransferFunction::Row> changedRows;
    for (int row = 0; row <= rows; ++row) {
        const double reaction = static_cast<double>(row) / rows;
        changedRows.push_back({reaction, emissionOf(reaction), flame.at(readAt(reaction)).a});
    }
    return raycast::TransferFunction(changedRows);
}

raycast::TransferFunction backwards(const raycast::TransferFunction& flame) {
    const auto other = [](double reaction) { return 1 - reaction; };
    return changed(
        flame, [&](double reaction) { return glm::vec3(flame.at(other(reaction))); }, other);
}

glm::dvec4 marched(const FireGrid& grid, const raycast::TransferFunction& flame, const raycast::Reflected& reflected,
                   const glm::dvec2& place) {
    raycast::PlainVolume volume;
    volume.grid = {
        {grid.cells, 2 * grid.cells, grid.cells}, spacingOf(grid.cells), {0, 0, 0}, grid.density, grid.reaction};
    volume.settings.extinctionPerMetre = extinctionPerMetre;
    volume.settings.stopAlpha = 1;
    volume.settings.fire = flame;
    volume.reflected = reflected;
    const double edge = spacingOf(grid.cells);
    return raycast::plainMarch(volume, {{place.x / edge, place.y / edge, grid.cells + 1.0}, {0, 0, -1}, 1e9, 0.5});
}

}  // namespace

Burning burn(int cells, double seconds, int particles, std::uint64_t seed) {
    MemoryLedger ledger;
    flow::FluidSolver solver(settingsOf(cells), ledger);
    const flow::FluidSource source = sourceOf(seed);
    const auto steps = static_cast<int>(std::lround(seconds / stepSeconds));
    // What the source adds, ∫ of its Gaussian, is the particles'.
    const double amount = static_cast<double>(source.densityPerSecond) * seconds *
                          std::pow(std::sqrt(2 * std::numbers::pi) * source.radiusMetres, 3);
    Burning burning;
    std::vector<Flake>& flakes = burning.particles;
    for (int step = 0; step < steps; ++step) {
        solver.step(stepSeconds, {&source, 1});
        if (particles > 0) {
            const Speeds speeds(solver);
            for (Flake& flake : flakes) {
                const glm::dvec3 halfway = flake.centre + 0.5 * stepSeconds * speeds.at(flake.centre);
                flake.centre += stepSeconds * speeds.at(halfway);
                flake.reaction = std::max(flake.reaction - burningPerSecond * stepSeconds, 0.0);
            }
        }
        for (auto serial = static_cast<std::int64_t>(flakes.size());
             serial < static_cast<std::int64_t>(particles) * (step + 1) / steps; ++serial) {
            const glm::dvec3 place = birthPlace(source, seed, static_cast<std::uint64_t>(serial));
            const glm::dvec3 aside = (place - source.centreMetres) / source.radiusMetres;
            flakes.push_back({place, 0, extinctionPerMetre * amount / particles,
                              static_cast<double>(source.reaction) * std::exp(-glm::dot(aside, aside) / 2)});
        }
    }
    burning.grid.cells = cells;
    for (const auto& [lane, values] :
         {std::pair{flow::density, &burning.grid.density}, {flow::reaction, &burning.grid.reaction}}) {
        values->resize(solver.box().cellCount());
        solver.gather(lane, *values);
    }
    return burning;
}

Picture pictureOf(const FireGrid& grid, const raycast::TransferFunction& flame, int width) {
    const raycast::Reflected reflected = smoke();
    return pictureByRays(width, [&](const glm::dvec2& place) { return marched(grid, flame, reflected, place); });
}

Picture pictureOf(std::vector<Flake> flakes, const raycast::TransferFunction& flame, int width) {
    constexpr double reach = 3;  // deviations, as billboards have
    std::ranges::stable_sort(flakes, {}, [](const Flake& flake) { return flake.centre.z; });
    const glm::dvec3 reflected(smoke().all());
    std::vector<glm::dvec4> looks;  // colour, and depth in the middle
    for (const Flake& flake : flakes) {
        const glm::dvec4 burning(flame.at(flake.reaction));
        looks.emplace_back(glm::dvec3(burning) + reflected, flake.depth * burning.a);
    }
    return pictureByRays(width, [&](const glm::dvec2& place) {
        glm::dvec4 seen(0);
        for (std::size_t i = 0; i < flakes.size(); ++i) {
            const double s = flakes[i].deviation;
            const glm::dvec2 apart = place - glm::dvec2(flakes[i].centre);
            const double square = glm::dot(apart, apart);
            if (square > reach * reach * s * s) continue;
            const double alpha = -std::expm1(-looks[i].a * std::exp(-square / (2 * s * s)));
            seen = alpha * glm::dvec4(glm::dvec3(looks[i]), 1) + (1 - alpha) * seen;
        }
        return seen;
    });
}

double distanceOf(const Picture& picture, const Picture& reference) {
    double apart = 0, whole = 0;
    for (std::size_t i = 0; i < picture.colours.size(); ++i) {
        const glm::dvec3 difference = picture.colours[i] - reference.colours[i];
        apart += glm::dot(difference, difference);
        whole += glm::dot(reference.colours[i], reference.colours[i]);
    }
    return std::sqrt(apart / whole);
}

double correlationOf(const Picture& picture, const FireGrid& of) {
    const raycast::TransferFunction freshness = changed(
        {}, [](double reaction) { return glm::vec3(static_cast<float>(reaction)); },
        [](double reaction) { return reaction; });
    const Picture burning =
        pictureByRays(picture.width, [&](const glm::dvec2& place) { return marched(of, freshness, {}, place); });
    std::vector<double> fresh, seen;
    for (std::size_t i = 0; i < picture.alphas.size(); ++i) {
        if (std::min(picture.alphas[i], burning.alphas[i]) < 1.0 / 255) continue;
        fresh.push_back(burning.colours[i].r / burning.alphas[i]);
        seen.push_back(glm::dot(picture.colours[i], glm::dvec3(0.2126, 0.7152, 0.0722)) / picture.alphas[i]);
    }
    return correlationOf(ranksOf(fresh), ranksOf(seen));
}

double piecesSeen(const Picture& picture, const std::vector<Flake>& pieces) {
    const double edge = widthMetres / picture.width;
    const auto alphaAt = [&](int x, int y) {
        return x < 0 || y < 0 || x >= picture.width || y >= picture.height
                   ? 0.0
                   : picture.alphas[static_cast<std::size_t>(y * picture.width + x)];
    };
    // Of equal neighbours the first counts.
    const auto isMaximum = [&](int x, int y) {
        const double alpha = alphaAt(x, y);
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const bool before = j < 0 || (j == 0 && i < 0), itself = j == 0 && i == 0;
                const double beside = alphaAt(x + i, y + j);
                if (before ? beside >= alpha : !itself && beside > alpha) return false;
            }
        return alpha > minimumAlpha;
    };
    // A maximum belongs to one piece at most.
    std::vector<bool> taken(picture.alphas.size());
    int seen = 0;
    for (const Flake& piece : pieces) {
        const glm::dvec2 middle = glm::dvec2(piece.centre) / edge;
        const int reach = std::max(1, static_cast<int>(std::lround(piece.deviation / edge)));
        const glm::ivec2 at(middle);
        bool found = false;
        for (int y = at.y - reach; y <= at.y + reach && !found; ++y)
            for (int x = at.x - reach; x <= at.x + reach && !found; ++x) {
                const auto i = static_cast<std::size_t>(y * picture.width + x);
                found = isMaximum(x, y) && !taken[i];
                if (found) taken[i] = true;
            }
        seen += found ? 1 : 0;
    }
    return static_cast<double>(seen) / static_cast<double>(pieces.size());
}

std::vector<Flake> scatter(int count, double deviation, std::uint64_t seed) {
    std::vector<Flake> pieces;
    for (int piece = 0; piece < count; ++piece) {
        const auto a = maths::uniform4(seed, 3, static_cast<std::uint64_t>(piece));
        pieces.push_back(
            {widthMetres * glm::dvec3(0.1 + 0.8 * static_cast<double>(a[0]), 0.1 + 1.8 * static_cast<double>(a[1]),
                                      0.1 + 0.8 * static_cast<double>(a[2])),
             deviation, 0.5, 0});
    }
    return pieces;
}

FireGrid gridOf(const std::vector<Flake>& pieces, int cells) {
    FireGrid grid{cells, std::vector<float>(2 * static_cast<std::size_t>(cells * cells * cells)), {}};
    const double edge = spacingOf(cells);
    const glm::ivec3 box(cells, 2 * cells, cells);
    parallel::forEachBlock(static_cast<std::size_t>(cells), 1, [&](std::size_t first, std::size_t) {
        const int z = static_cast<int>(first);
        for (const Flake& piece : pieces) {
            // A cell's average of a Gaussian is the product of three differences of erf.
            const double scale = 1 / (std::numbers::sqrt2 * piece.deviation);
            const auto share = [&](int cell, int axis) {
                const auto below = [&](int face) { return std::erf((face * edge - piece.centre[axis]) * scale) / 2; };
                return below(cell + 1) - below(cell);
            };
            const double mass = piece.depth * 2 * std::numbers::pi * piece.deviation * piece.deviation;
            const double ofSlab = mass * share(z, 2) / (extinctionPerMetre * edge * edge * edge);
            const double reach = 5 * piece.deviation + edge;
            if (std::abs((z + 0.5) * edge - piece.centre.z) > reach) continue;
            const glm::ivec3 low = glm::max(glm::ivec3((piece.centre - reach) / edge), 0),
                             high = glm::min(glm::ivec3((piece.centre + reach) / edge), box - 1);
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    grid.density[static_cast<std::size_t>((z * box.y + y) * box.x + x)] +=
                        static_cast<float>(ofSlab * share(x, 0) * share(y, 1));
        }
    });
    return grid;
}

namespace {

/// What was found in each fire and each scattering.
using Found = std::map<std::string, std::vector<double>>;

std::vector<Flake> widened(std::vector<Flake> particles, double deviation) {
    for (Flake& particle : particles) {
        particle.depth /= 2 * std::numbers::pi * deviation * deviation;
        particle.deviation = deviation;
    }
    return particles;
}

void measureFire(Found& found, int cells, std::uint64_t seed) {
    constexpr double seconds = 1.2;
    constexpr int particles = 5000;  // as the paper's Figure 18 c
    constexpr int width = 64;
    const raycast::TransferFunction flame;
    const Burning fire = burn(cells, seconds, particles, seed);
    const FireGrid finer = burn(2 * cells, seconds, 0, seed).grid;
    const Picture reference = pictureOf(finer, flame, width);
    const Picture volume = pictureOf(fire.grid, flame, width), wrong = pictureOf(fire.grid, backwards(flame), width);
    double least = std::numeric_limits<double>::infinity(), correlation = 0;
    for (const double ofCells : {0.5, 1.0, 2.0}) {
        const Picture shown = pictureOf(widened(fire.particles, ofCells * spacingOf(cells)), flame, width);
        const double distance = distanceOf(shown, reference);
        if (distance >= least) continue;
        least = distance;
        correlation = correlationOf(shown, finer);
    }
    found["error_ratio"].push_back(std::log(distanceOf(volume, reference) / least));
    found["control_error_ratio"].push_back(std::log(distanceOf(wrong, reference) / least));
    found["correlation_lead"].push_back(correlationOf(volume, finer) - correlation);
    found["control_correlation_lead"].push_back(correlationOf(wrong, finer) - correlation);
}

struct Pieces {
    std::string name;
    int count;
    double widthCells;
};

void measurePieces(Found& found, int cells, std::uint64_t seed) {
    constexpr int scatterings = 10, width = 128;
    const raycast::TransferFunction flame;
    for (const Pieces& pieces : {Pieces{"pieces_lead", 30, 0.25}, {"control_pieces_lead", 4, 2.0}}) {
        double lead = 0;
        for (std::uint64_t scattering = 0; scattering < scatterings; ++scattering) {
            const std::vector<Flake> scattered =
                scatter(pieces.count, pieces.widthCells * spacingOf(cells), scatterings * seed + scattering);
            lead += piecesSeen(pictureOf(scattered, flame, width), scattered) -
                    piecesSeen(pictureOf(gridOf(scattered, cells), flame, width), scattered);
        }
        found[pieces.name].push_back(lead / scatterings);
    }
}

std::vector<Finding> measureAll(ExperimentContext& context) {
    const int cells = context.quick() ? 20 : 32, seeds = context.quick() ? 5 : 12;
    Found found;
    for (int fire = 0; fire < seeds; ++fire) {
        const std::uint64_t seed = 1000 * context.seed() + static_cast<std::uint64_t>(fire);
        measureFire(found, cells, seed);
        measurePieces(found, cells, seed);
    }
    std::vector<Finding> all;
    for (const auto& [name, values] : found) {
        Finding finding = findings::meanOf(name, values);
        if (name.ends_with("error_ratio"))
            for (double* const value : {&finding.value, &finding.low, &finding.high}) *value = std::exp(*value);
        all.push_back(finding);
    }
    return all;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Whether a volume shows fire better than particles do, and particles single pieces.";
    info.source = "Senger2009";
    info.run = measureAll;
    return info;
}

}  // namespace dustbench::grid_fluid::fire
