#include "methods/grid_fluid/fire_experiment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::fire {
namespace {

constexpr double stepSeconds = 1.0 / 60;
constexpr double burningPerSecond = 1.1;

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
    settings.box = {{cells, 2 * cells, cells}, widthMetres / cells, {0, 0, 0}};
    settings.sides = flow::closed;
    settings.advection = {flow::AdvectionScheme::macCormack, flow::Limit::revert};
    settings.forces.buoyancyPerKelvin = 0.03f;
    settings.forces.coolingPerSecond = 0.9f;
    settings.forces.reactionLossPerSecond = static_cast<float>(burningPerSecond);
    return settings;
}

/// Trilinear between the centres of the cells, constant beyond the outermost ones.
class Speeds {
 public:
    explicit Speeds(const flow::FluidSolver& solver)
        : cells_(solver.box().cells), spacing_(solver.box().spacingMetres), values_(solver.box().cellCount()) {
        std::vector<float> component(values_.size());
        for (int axis = 0; axis < 3; ++axis) {
            solver.gather(static_cast<flow::Lane>(flow::velocityX + axis), component);
            for (std::size_t i = 0; i < values_.size(); ++i) values_[i][axis] = component[i];
        }
    }

    [[nodiscard]] glm::dvec3 at(const glm::dvec3& place) const {
        const glm::dvec3 fromMiddle = glm::clamp(place / spacing_ - 0.5, glm::dvec3(0), glm::dvec3(cells_ - 1) - 1e-9);
        const glm::ivec3 low(fromMiddle);
        const glm::dvec3 t = fromMiddle - glm::dvec3(low);
        const auto alongX = [&](int y, int z) {
            const auto cell = static_cast<std::size_t>(low.x + cells_.x * (low.y + y + cells_.y * (low.z + z)));
            return glm::mix(glm::dvec3(values_[cell]), glm::dvec3(values_[cell + 1]), t.x);
        };
        return glm::mix(glm::mix(alongX(0, 0), alongX(1, 0), t.y), glm::mix(alongX(0, 1), alongX(1, 1), t.y), t.z);
    }

    /// The place one step earlier of the air that is at `place` now.
    [[nodiscard]] glm::dvec3 before(const glm::dvec3& place) const {
        return place - stepSeconds * at(place - 0.5 * stepSeconds * at(place));
    }

 private:
    glm::ivec3 cells_;
    double spacing_;
    std::vector<glm::vec3> values_;
};

/// A fire by the paths of its air, which moved at `speeds[n]` in step n: φ(x, t) = ∫ source(X(t')) dt'.
glm::dvec2 burningAt(const std::vector<Speeds>& speeds, const flow::FluidSource& source, glm::dvec3 place) {
    glm::dvec2 found(0);
    const double addedPerStep = static_cast<double>(source.densityPerSecond) * stepSeconds;
    double ageSeconds = 0;
    // First the air moves, then the source emits, then the fire burns.
    for (auto air = speeds.rbegin(); air != speeds.rend(); ++air) {
        const glm::dvec3 aside = (place - source.centreMetres) / source.radiusMetres;
        const double square = glm::dot(aside, aside);
        ageSeconds += stepSeconds;
        if (square < 30) {
            const double strength = std::exp(-square / 2);
            found.x += strength * addedPerStep;
            found.y =
                std::max(found.y, strength * static_cast<double>(source.reaction) - burningPerSecond * ageSeconds);
        }
        place = air->before(place);
    }
    return found;
}

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

/// Shows fresh fire as burnt out, and vice versa.
raycast::TransferFunction backwards(const raycast::TransferFunction& flame) {
    constexpr int rows = 64;
    std::vector<raycast::TransferFunction::Row> turned;
    for (int row = 0; row <= rows; ++row) {
        const glm::vec4 look = flame.at(1 - static_cast<double>(row) / rows);
        turned.push_back({static_cast<double>(row) / rows, glm::vec3(look), look.a});
    }
    return raycast::TransferFunction(turned);
}

}  // namespace

Burning burn(int cells, double seconds, int particles, std::uint64_t seed, Paths paths) {
    MemoryLedger ledger;
    flow::FluidSolver solver(settingsOf(cells), ledger);
    const flow::FluidSource source = sourceOf(seed);
    const auto steps = static_cast<int>(std::lround(seconds / stepSeconds));
    // The particles have the amount that the source adds, the integral of its Gaussian.
    const double amount = static_cast<double>(source.densityPerSecond) * seconds *
                          std::pow(std::sqrt(2 * std::numbers::pi) * source.radiusMetres, 3);
    Burning burning;
    std::vector<Flake>& flakes = burning.particles;
    std::vector<Speeds> air;
    for (int step = 0; step < steps; ++step) {
        if (paths == Paths::kept) air.emplace_back(solver);
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
    if (paths == Paths::kept)
        burning.field = [air = std::move(air), source](const glm::dvec3& place) {
            return burningAt(air, source, place);
        };
    return burning;
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
    const double edge = widthMetres / cells;
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

/// The results for each fire and each set of pieces.
using Found = std::map<std::string, std::vector<double>>;

std::vector<Flake> widened(std::vector<Flake> particles, double deviation) {
    for (Flake& particle : particles) {
        particle.depth /= 2 * std::numbers::pi * deviation * deviation;
        particle.deviation = deviation;
    }
    return particles;
}

/// A fire's pictures, for comparison with those of other fires.
struct Shown {
    double sourceX;
    Picture volume;
    std::map<std::string, Picture> references;
    std::map<std::string, double> particleDistances;  ///< from the reference, of the nearest particles
};

Shown measureFire(Found& found, int cells, std::uint64_t seed) {
    constexpr double seconds = 1.2;
    constexpr int particles = 5000;  // as in the paper's Figure 18 c
    constexpr int width = 64;
    const raycast::TransferFunction flame;
    const Burning fire = burn(cells, seconds, particles, seed);
    const Burning finer = burn(2 * cells, seconds, 0, seed, Paths::kept);
    const FieldPictures byPaths = picturesOf(finer.field, widthMetres / (2 * cells), flame, width),
                        byVolume{pictureOf(finer.grid, flame, width), freshnessOf(finer.grid, width)};
    const Picture volume = pictureOf(fire.grid, flame, width), wrong = pictureOf(fire.grid, backwards(flame), width);
    std::map<std::string, double> particleDistances;
    for (const auto& [name, reference] : {std::pair("_by_paths", &byPaths), {"_by_volume", &byVolume}}) {
        double least = std::numeric_limits<double>::infinity(), correlation = 0;
        for (const double ofCells : {0.5, 1.0, 2.0}) {
            const Picture shown = pictureOf(widened(fire.particles, ofCells * widthMetres / cells), flame, width);
            const double distance = distanceOf(shown, reference->shown);
            if (distance >= least) continue;
            least = distance;
            correlation = correlationOf(shown, reference->freshness);
        }
        const auto add = [&](const std::string& quantity, double value) { found[quantity + name].push_back(value); };
        add("error_ratio", std::log(distanceOf(volume, reference->shown) / least));
        add("control_error_ratio", std::log(distanceOf(wrong, reference->shown) / least));
        particleDistances[name] = least;
        add("correlation_lead", correlationOf(volume, reference->freshness) - correlation);
        add("control_correlation_lead", correlationOf(wrong, reference->freshness) - correlation);
    }
    found["references_apart"].push_back(std::log(distanceOf(byVolume.shown, byPaths.shown)));
    return {sourceOf(seed).centreMetres.x,
            volume,
            {{"_by_paths", byPaths.shown}, {"_by_volume", byVolume.shown}},
            particleDistances};
}

/// The picture moved to the right by whole pixels; nothing comes in from the side.
Picture moved(const Picture& picture, double metres) {
    const auto columns = static_cast<int>(std::lround(metres / widthMetres * picture.width));
    Picture result{picture.width, picture.height, std::vector<glm::dvec3>(picture.colours.size(), glm::dvec3(0)),
                   std::vector<double>(picture.alphas.size(), 0)};
    for (int y = 0; y < picture.height; ++y)
        for (int x = std::max(0, columns); x < std::min(picture.width, picture.width + columns); ++x) {
            const auto to = static_cast<std::size_t>(y * picture.width + x);
            const auto from = static_cast<std::size_t>(y * picture.width + x - columns);
            result.colours[to] = picture.colours[from];
            result.alphas[to] = picture.alphas[from];
        }
    return result;
}

/// Compares the volume and the particles with video textures: the references' pictures of the next three fires, at the
/// place of this one. The nearest counts. The control's video is of this very fire: its reference as a volume.
void measureVideos(Found& found, const std::vector<Shown>& fires) {
    constexpr std::size_t videos = 3;
    for (std::size_t i = 0; i < fires.size(); ++i) {
        for (const auto& [name, reference] : fires[i].references) {
            const double volume = distanceOf(fires[i].volume, reference);
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t v = 1; v <= std::min(videos, fires.size() - 1); ++v) {
                const Shown& other = fires[(i + v) % fires.size()];
                const Picture video = moved(other.references.at(name), fires[i].sourceX - other.sourceX);
                nearest = std::min(nearest, distanceOf(video, reference));
            }
            found["error_ratio_video" + name].push_back(std::log(volume / nearest));
            found["error_ratio_video_over_particles" + name].push_back(
                std::log(nearest / fires[i].particleDistances.at(name)));
        }
        const Picture &reference = fires[i].references.at("_by_paths"), &own = fires[i].references.at("_by_volume");
        const double ofOwn = distanceOf(own, reference);
        found["control_error_ratio_video_by_paths"].push_back(std::log(distanceOf(fires[i].volume, reference) / ofOwn));
        found["error_ratio_own_video_over_particles_by_paths"].push_back(
            std::log(ofOwn / fires[i].particleDistances.at("_by_paths")));
    }
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
                scatter(pieces.count, pieces.widthCells * widthMetres / cells, scatterings * seed + scattering);
            lead += piecesSeen(pictureOf(scattered, flame, width), scattered) -
                    piecesSeen(pictureOf(gridOf(scattered, cells), flame, width), scattered);
        }
        found[pieces.name].push_back(lead / scatterings);
    }
}

std::vector<Finding> measureAll(ExperimentContext& context) {
    const int cells = context.quick() ? 20 : 32, seeds = context.quick() ? 5 : 12;
    Found found;
    std::vector<Shown> fires;
    for (int fire = 0; fire < seeds; ++fire) {
        const std::uint64_t seed = 1000 * context.seed() + static_cast<std::uint64_t>(fire);
        fires.push_back(measureFire(found, cells, seed));
        measurePieces(found, cells, seed);
    }
    measureVideos(found, fires);
    std::vector<Finding> all;
    for (const auto& [name, values] : found) {
        Finding finding = findings::meanOf(name, values);
        if (name.find("error_ratio") != std::string::npos || name == "references_apart")
            for (double* const value : {&finding.value, &finding.low, &finding.high}) *value = std::exp(*value);
        all.push_back(finding);
    }
    return all;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Tests whether volumes show fire better than particles, and particles show single pieces better.";
    info.source = "Senger2009";
    info.run = measureAll;
    return info;
}

}  // namespace dustbench::grid_fluid::fire
