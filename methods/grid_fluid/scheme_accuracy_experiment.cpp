#include "methods/grid_fluid/scheme_accuracy_experiment.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <map>
#include <string>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/findings/timing.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::grid_fluid::scheme_accuracy {
namespace {

using flow::AdvectionScheme;

constexpr double widthMetres = 3.2;
constexpr double stepSeconds = 1.0 / 60;
constexpr double jetSeconds = 1.2;

glm::ivec3 cellsOf(int cells) {
    return {cells, 2 * cells, cells};
}

flow::FluidSource jetOf(std::uint64_t seed) {
    const auto a = maths::uniform4(seed, 1, 0), b = maths::uniform4(seed, 2, 0);
    flow::FluidSource source;
    source.centreMetres = {widthMetres * (0.5 + 0.1 * static_cast<double>(maths::centred(a[0]))), 0.9,
                           widthMetres * (0.5 + 0.1 * static_cast<double>(maths::centred(a[1])))};
    source.radiusMetres = 0.35;
    source.densityPerSecond = 4;
    source.velocityMetresPerSecond = {0.5f * maths::centred(b[0]), 2.5f + a[2], 0.5f * maths::centred(b[1])};
    source.velocityPerSecond = 20;
    return source;
}

flow::FluidSettings settingsOf(AdvectionScheme scheme, int cells) {
    flow::FluidSettings settings;
    settings.box = {cellsOf(cells), widthMetres / cells, {0, 0, 0}};
    settings.sides = flow::closed;
    settings.advection = {scheme, flow::Limit::revert};
    return settings;
}

/// Means over blocks of refinement³ cells.
std::vector<float> averaged(const std::vector<float>& fine, const glm::ivec3& cells, int refinement) {
    std::vector<float> means;
    const int across = cells.x * refinement, up = cells.y * refinement;
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                double sum = 0;
                for (int k = 0; k < refinement; ++k)
                    for (int j = 0; j < refinement; ++j)
                        for (int i = 0; i < refinement; ++i)
                            sum += static_cast<double>(fine[static_cast<std::size_t>(
                                ((z * refinement + k) * up + y * refinement + j) * across + x * refinement + i)]);
                means.push_back(static_cast<float>(sum / (refinement * refinement * refinement)));
            }
    return means;
}

double squareOf(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) sum += static_cast<double>(value) * static_cast<double>(value);
    return sum;
}

double squareOfDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double apart = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        sum += apart * apart;
    }
    return sum;
}

std::vector<float> summedAlongZ(const std::vector<float>& values, int edge) {
    const auto layer = static_cast<std::size_t>(edge) * static_cast<std::size_t>(2 * edge);
    std::vector<float> sums(layer);
    for (std::size_t i = 0; i < values.size(); ++i) sums[i % layer] += values[i];
    return sums;
}

/// Σω² by central differences, without the outermost cells.
double enstrophyOf(const CoarseFlow& flow, int edge) {
    const glm::ivec3 cells = cellsOf(edge);
    double sum = 0;
    for (int z = 1; z + 1 < cells.z; ++z)
        for (int y = 1; y + 1 < cells.y; ++y)
            for (int x = 1; x + 1 < cells.x; ++x) {
                const int at = (z * cells.y + y) * cells.x + x;
                const std::array<int, 3> next{1, cells.x, cells.x * cells.y};
                const auto slope = [&](std::size_t component, std::size_t axis) {
                    const std::vector<float>& speed = flow.velocity[component];
                    return static_cast<double>(speed[static_cast<std::size_t>(at + next[axis])] -
                                               speed[static_cast<std::size_t>(at - next[axis])]);
                };
                const glm::dvec3 curl(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1));
                sum += glm::dot(curl, curl);
            }
    return sum;
}

/// Σ|u|² minus that of the means over 2³ cells.
double detailOf(const CoarseFlow& flow, int edge) {
    double sum = 0;
    for (const std::vector<float>& speed : flow.velocity)
        sum += squareOf(speed) - 8 * squareOf(averaged(speed, cellsOf(edge / 2), 2));
    return sum;
}

}  // namespace

CoarseFlow jetAfter(double seconds, AdvectionScheme scheme, int cells, int refinement, std::uint64_t seed) {
    MemoryLedger ledger;
    flow::FluidSolver solver(settingsOf(scheme, cells * refinement), ledger);
    const flow::FluidSource source = jetOf(seed);
    const auto steps = static_cast<int>(std::lround(seconds / stepSeconds));
    for (int step = 0; step < steps; ++step) solver.step(stepSeconds, {&source, 1});
    std::vector<float> fine(solver.box().cellCount());
    const auto coarse = [&](flow::Lane lane) {
        solver.gather(lane, fine);
        return averaged(fine, cellsOf(cells), refinement);
    };
    return {coarse(flow::density), {coarse(flow::velocityX), coarse(flow::velocityY), coarse(flow::velocityZ)}};
}

Distance distanceOf(const CoarseFlow& flow, const CoarseFlow& reference, int cells) {
    const auto apart = [](const std::vector<float>& a, const std::vector<float>& b) {
        return std::sqrt(squareOfDifference(a, b) / squareOf(b));
    };
    const auto ofLogarithms = [](double a, double b) { return std::abs(std::log(a / b)); };
    double difference = 0, whole = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        difference += squareOfDifference(flow.velocity[axis], reference.velocity[axis]);
        whole += squareOf(reference.velocity[axis]);
    }
    return {apart(flow.density, reference.density),
            apart(summedAlongZ(flow.density, cells), summedAlongZ(reference.density, cells)),
            std::sqrt(difference / whole), ofLogarithms(enstrophyOf(flow, cells), enstrophyOf(reference, cells)),
            ofLogarithms(detailOf(flow, cells), detailOf(reference, cells))};
}

namespace {

/// The logarithms of each finding in each jet.
using Found = std::map<std::string, std::vector<double>>;

void measureJet(Found& found, int cells, std::uint64_t seed) {
    const auto after = [&](AdvectionScheme scheme, int refinement) {
        return jetAfter(jetSeconds, scheme, cells, refinement, seed);
    };
    const CoarseFlow plain = after(AdvectionScheme::semiLagrangian, 1),
                     plainFiner = after(AdvectionScheme::semiLagrangian, 2),
                     corrected = after(AdvectionScheme::macCormack, 1);
    for (const auto& [scheme, advection] : {std::pair{"by_semi_lagrangian", AdvectionScheme::semiLagrangian},
                                            {"by_maccormack", AdvectionScheme::macCormack}}) {
        const CoarseFlow reference = after(advection, 4);
        const Distance ofPlain = distanceOf(plain, reference, cells),
                       ofFiner = distanceOf(plainFiner, reference, cells),
                       ofCorrected = distanceOf(corrected, reference, cells);
        for (const auto& [measure, of] : {std::pair{"density", &Distance::density},
                                          {"picture", &Distance::picture},
                                          {"velocity", &Distance::velocity},
                                          {"enstrophy", &Distance::enstrophy},
                                          {"detail", &Distance::detail}})
            for (const auto& [name, ratio] : {std::pair{"nearer", ofCorrected.*of / ofPlain.*of},
                                              {"finer", ofCorrected.*of / ofFiner.*of},
                                              {"control", ofPlain.*of / ofFiner.*of}})
                found[fmt::format("{}_{}_{}", name, measure, scheme)].push_back(std::log(ratio));
    }
}

Finding geometricMeanOf(const std::string& name, const std::vector<double>& logarithms) {
    Finding finding = findings::meanOf(name, logarithms);
    for (double* const value : {&finding.value, &finding.low, &finding.high}) *value = std::exp(*value);
    return finding;
}

/// Processor time of MacCormack's steps, divided by that of semi-Lagrangian steps in a grid of `refinement` times the
/// cells along each axis; measured alternately in one thread.
std::vector<double> timeRatios(int cells, int refinement, int pairs) {
    std::vector<double> ratios;
    tbb::task_arena(1).execute([&] {
        MemoryLedger ledger;
        const flow::FluidSource source = jetOf(1);
        flow::FluidSolver plain(settingsOf(AdvectionScheme::semiLagrangian, refinement * cells), ledger),
            corrected(settingsOf(AdvectionScheme::macCormack, cells), ledger);
        const int stepsAtOnce = refinement > 1 ? 1 : 5;
        const auto secondsOf = [&](flow::FluidSolver& solver) {
            return findings::secondsOf([&] {
                for (int step = 0; step < stepsAtOnce; ++step) solver.step(stepSeconds, {&source, 1});
            });
        };
        for (int pair = -1; pair < pairs; ++pair) {  // the first warms up
            const double ofPlain = secondsOf(plain), ofCorrected = secondsOf(corrected);
            if (pair >= 0) ratios.push_back(ofCorrected / ofPlain);
        }
    });
    return ratios;
}

/// Bytes of MacCormack's solver, divided by those of the semi-Lagrangian solver in a grid twice as fine.
double bytesRatio(int cells) {
    const auto bytesOf = [&](AdvectionScheme scheme, int edge) {
        MemoryLedger ledger;
        flow::FluidSolver solver(settingsOf(scheme, edge), ledger);
        solver.step(stepSeconds, {});
        return static_cast<double>(ledger.totalBytes());
    };
    return bytesOf(AdvectionScheme::macCormack, cells) / bytesOf(AdvectionScheme::semiLagrangian, 2 * cells);
}

std::vector<Finding> measureAll(ExperimentContext& context) {
    const int cells = context.quick() ? 16 : 24, jets = context.quick() ? 5 : 12;
    Found found;
    for (int jet = 0; jet < jets; ++jet)
        measureJet(found, cells, 1000 * context.seed() + static_cast<std::uint64_t>(jet));
    std::vector<Finding> all;
    for (const auto& [name, values] : found) all.push_back(geometricMeanOf(name, values));
    const int pairs = context.quick() ? 9 : 15;
    for (const auto& [name, refinement] : {std::pair{"", 1}, {"_finer", 2}}) {
        std::vector<double> ratios = timeRatios(2 * cells, refinement, pairs), back;
        for (const double ratio : ratios) back.push_back(1 / ratio);
        all.push_back(findings::medianOf(std::string("time_ratio") + name, ratios));
        all.push_back(findings::medianOf(std::string("time_ratio") + name + "_back", back));
    }
    const double bytes = bytesRatio(2 * cells);
    all.push_back({"bytes_ratio_finer", bytes, bytes, bytes, 1});
    all.push_back({"bytes_ratio_finer_back", 1 / bytes, 1 / bytes, 1 / bytes, 1});
    return all;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures how much finer a grid MacCormack advection is equivalent to, and its cost.";
    info.source = "Senger2009";
    info.run = measureAll;
    return info;
}

}  // namespace dustbench::grid_fluid::scheme_accuracy
