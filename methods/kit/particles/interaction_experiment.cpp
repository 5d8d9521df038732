#include "methods/kit/particles/interaction_experiment.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "methods/kit/findings/findings.h"
#include "methods/kit/findings/timing.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/attraction.h"

namespace dustbench::particles::interaction {
namespace {

using findings::exponentOf, findings::medianOf, findings::secondsOf;

constexpr Attraction bySquare{AttractionLaw::inverseSquare, 1, 0.1f};
constexpr Attraction byCube{AttractionLaw::inverseCube, 1, 0.1f};
constexpr float onePercentAngle = 0.65f;
constexpr int repetitions = 5;

struct Bodies3 {
    std::vector<float> x, y, z, mass, ax, ay, az;

    Bodies3(std::size_t count, std::uint64_t seed) : x(count), y(count), z(count), mass(count, 1) {
        for (auto* column : {&ax, &ay, &az}) column->resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto u = maths::uniform4(seed, 1, i), v = maths::uniform4(seed, 2, i);
            const glm::vec3 p = 10.0f * maths::ballPoint(u[0], u[1], u[2], u[3], v[0]);
            x[i] = p.x, y[i] = p.y, z[i] = p.z;
        }
    }
    /// Computes the exact forces on `count` bodies from `first` on.
    void pullPairs(std::size_t first, std::size_t count, const Attraction& attraction = bySquare) {
        constexpr std::size_t block = 256;
        for (std::size_t i = first; i < first + count; i += block) {
            const std::size_t size = std::min(block, first + count - i);
            for (auto* column : {&ax, &ay, &az}) std::fill_n(&(*column)[i], size, 0.0f);
            addPull(attraction, {x, y, z, mass}, {size, &x[i], &y[i], &z[i], &ax[i], &ay[i], &az[i]});
        }
    }
    void pullTree(float angle, FarBodies farBodies = FarBodies::centreOfMass, const Attraction& attraction = bySquare) {
        AttractionTree tree;
        tree.build(x, y, z);
        tree.pull(attraction, angle, farBodies, ax, ay, az);
    }
};

/// Returns the error over the bodies from 0 to `count`. They are unordered, so they form a random sample. The interval
/// is that of the mean square.
Finding errorOf(std::string quantity, const Bodies3& exact, const Bodies3& tree, std::size_t count) {
    double sum = 0, squares = 0, size = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 e(exact.ax[i], exact.ay[i], exact.az[i]), t(tree.ax[i], tree.ay[i], tree.az[i]);
        const double error = glm::dot(e - t, e - t);
        sum += error;
        squares += error * error;
        size += glm::dot(e, e);
    }
    const auto n = static_cast<double>(count);
    const double half = 1.96 * std::sqrt(std::max(squares / n - sum * sum / (n * n), 0.0) / n);
    const auto relative = [&](double meanSquare) { return std::sqrt(std::max(meanSquare, 0.0) / (size / n)); };
    return {std::move(quantity), relative(sum / n), relative(sum / n - half), relative(sum / n + half),
            static_cast<std::int64_t>(count)};
}

/// The ratio of two errors, with the interval that follows from both intervals.
Finding ratioOfErrors(std::string quantity, const Finding& above, const Finding& below) {
    return {std::move(quantity), above.value / below.value, above.low / below.high, above.high / below.low,
            above.samples};
}

/// For a force that falls like 1/d³: combined at the angle at which the error of 1/d² is measured, and ignored there
/// and at smaller angles, which leave out fewer bodies.
void measureCube(std::uint64_t seed, std::size_t count, std::size_t sample, std::vector<Finding>& findings) {
    Bodies3 exact(count, seed), tree(count, seed);
    exact.pullPairs(0, sample, byCube);
    tree.pullTree(0.6f, FarBodies::centreOfMass, byCube);
    findings.push_back(errorOf("rms_cube_angle_0.6", exact, tree, sample));
    for (const float angle : {0.1f, 0.3f, 0.6f}) {
        tree.pullTree(angle, FarBodies::ignored, byCube);
        findings.push_back(errorOf(fmt::format("rms_cube_ignored_{:.1f}", angle), exact, tree, sample));
    }
}

/// Returns the median time of the forces on all bodies.
double medianSeconds(Bodies3& bodies, bool byTree) {
    return medianOf("",
                    [&] {
                        std::vector<double> seconds;
                        seconds.reserve(repetitions);
                        for (int k = 0; k < repetitions; ++k)
                            seconds.push_back(secondsOf([&] {
                                byTree ? bodies.pullTree(onePercentAngle) : bodies.pullPairs(0, bodies.x.size());
                            }));
                        return seconds;
                    }())
        .value;
}

std::vector<double> timesOf(const std::vector<double>& counts, std::uint64_t seed, bool byTree) {
    std::vector<double> seconds;
    for (const double count : counts) {
        Bodies3 bodies(static_cast<std::size_t>(count), seed);
        seconds.push_back(medianSeconds(bodies, byTree));
    }
    return seconds;
}

/// Returns the number of bodies at which the ratio of the times, interpolated over the logarithm of the number, passes
/// 1; the interval is given by the two adjacent counts.
Finding crossover(std::uint64_t seed) {
    const std::vector<double> counts{128, 256, 512, 1024, 2048, 4096, 8192};
    const auto pairs = timesOf(counts, seed, false), tree = timesOf(counts, seed, true);
    for (std::size_t i = 1; i < counts.size(); ++i) {
        const double before = std::log(pairs[i - 1] / tree[i - 1]), after = std::log(pairs[i] / tree[i]);
        if (before < 0 && after >= 0) {
            const double share = before / (before - after);
            return {"crossover_bodies", counts[i - 1] * std::pow(counts[i] / counts[i - 1], share), counts[i - 1],
                    counts[i], repetitions};
        }
    }
    const double end = pairs.front() >= tree.front() ? counts.front() : counts.back();
    return {"crossover_bodies", end, end, end, repetitions};
}

/// For 256 bodies: building a tree takes longer than all pairs.
Finding speedupOfFew(std::uint64_t seed) {
    Bodies3 exact(256, seed), tree(256, seed);
    std::vector<double> speedups;
    speedups.reserve(repetitions);
    for (int k = 0; k < repetitions; ++k)
        speedups.push_back(secondsOf([&] { exact.pullPairs(0, 256); }) /
                           secondsOf([&] { tree.pullTree(onePercentAngle); }));
    return medianOf("speedup_256", speedups);
}

void measureTimes(std::uint64_t seed, std::vector<Finding>& findings) {
    const std::vector<double> few{1000, 2000, 4000, 8000, 16000}, many{4000, 8000, 16000, 32000, 64000};
    findings.push_back(exponentOf("pairs_exponent", few, timesOf(few, seed, false)));
    findings.push_back(exponentOf("tree_exponent", many, timesOf(many, seed, true)));
    findings.push_back(crossover(seed));
    findings.push_back(speedupOfFew(seed));

    constexpr std::size_t count = 100'000, slice = 4096;  // the pairs of a slice take 1/24 of the total time
    Bodies3 exact(count, seed), tree(count, seed);
    std::vector<double> speedups;
    for (int k = 0; k < repetitions; ++k) {
        const double all = secondsOf([&] { exact.pullPairs(0, slice); }) * count / slice;
        speedups.push_back(all / secondsOf([&] { tree.pullTree(onePercentAngle); }));
    }
    findings.push_back(errorOf("rms_100k", exact, tree, slice));
    findings.push_back(medianOf("speedup_100k", speedups));
}

}  // namespace

std::vector<Finding> measureErrors(std::uint64_t seed) {
    std::vector<Finding> findings;
    constexpr std::size_t count = 20'000, sample = 2048;
    Bodies3 exact(count, seed), tree(count, seed);
    exact.pullPairs(0, sample);
    std::vector<double> angles, errors;
    for (const float angle : {0.3f, 0.4f, 0.5f, 0.6f, 0.8f, 1.0f, 1.2f}) {
        tree.pullTree(angle);
        findings.push_back(errorOf(fmt::format("rms_angle_{:.1f}", angle), exact, tree, sample));
        angles.push_back(static_cast<double>(angle));
        errors.push_back(findings.back().value);
    }
    findings.push_back(exponentOf("error_exponent", angles, errors));
    tree.pullTree(0.6f, FarBodies::ignored);
    findings.push_back(errorOf("rms_ignored_0.6", exact, tree, sample));
    const auto found = [&](std::string_view quantity) {
        return *std::ranges::find(findings, quantity, &Finding::quantity);
    };
    const Finding centreOfMass = found("rms_angle_0.6"), ignored = found("rms_ignored_0.6");
    findings.push_back(ratioOfErrors("ignored_over_together_0.6", ignored, centreOfMass));
    findings.push_back(ratioOfErrors("together_over_together_0.6", centreOfMass, centreOfMass));
    measureCube(seed, count, sample, findings);

    std::vector<double> counts, pairs;
    for (const std::size_t n : {4000, 8000, 16000, 32000, 64000}) {
        const Bodies3 bodies(n, seed);
        AttractionTree cells;
        cells.build(bodies.x, bodies.y, bodies.z);
        counts.push_back(static_cast<double>(n));
        pairs.push_back(static_cast<double>(cells.pairs(onePercentAngle, FarBodies::centreOfMass)));
    }
    findings.push_back(exponentOf("tree_work_exponent", counts, pairs));
    return findings;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures cost and accuracy of forces between particles, by all pairs and by a tree.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) {
        std::vector<Finding> findings = measureErrors(context.seed());
        tbb::task_arena(1).execute([&] { measureTimes(context.seed(), findings); });
        return findings;
    };
    return info;
}

}  // namespace dustbench::particles::interaction
