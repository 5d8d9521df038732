// For tests: made-up machines, each with one folder of results, with times from a formula.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/machines/machine_comparison.h"
#include "bench/report/run_groups.h"

namespace dustbench::report {

/// The properties of a made-up run.
struct MadeRun {
    std::string method;
    int particles = 0, repetition = 1, seed = 1;
    double ms = 1;
    std::string size = "64x48";
};

inline results::StoredRun madeRun(const MadeRun& made, const std::string& cpu) {
    results::StoredRun run;
    const std::string key = fmt::format(
        "method={}\nscene=plain\ndrive=straight\np.particles={}\nframes=9\nwarmup=1\nsize={}\nseed={}\n"
        "threads=0\nsync=frame\nimages=0\n",
        made.method, made.particles, made.size, made.seed);
    run.runId = fmt::format("{}-{}-{}-s{}-r{}", made.method, made.size, made.particles, made.seed, made.repetition);
    run.parameters["particles"] = std::to_string(made.particles);
    run.cells = {{"method", made.method},
                 {"scene", "plain"},
                 {"seed", std::to_string(made.seed)},
                 {"repetition", std::to_string(made.repetition)},
                 {"threads", "2"},
                 {"frames", "9"},
                 {"frame_ms_median", fmt::format("{}", made.ms)},
                 {"fps_avg", fmt::format("{}", 1000 / made.ms)}};
    run.provenance = {{"key", fmt::format("{}repetition={}\n", key, made.repetition)},
                      {"cpu", cpu},
                      {"cores", "2"},
                      {"ram_bytes", "8589934592"},
                      {"gl_renderer", "Card of " + cpu},
                      {"git_commit", "0123456789abcdef"},
                      {"build_type", "Release"}};
    run.stateHash = fmt::format("state of {} {}", made.particles, made.seed);
    run.inputs = {{"scenes/plain.toml", "01"}};
    return run;
}

inline results::StoredRuns storedRuns(const std::vector<MadeRun>& made, const std::string& cpu) {
    results::StoredRuns runs;
    for (const MadeRun& one : made) {
        results::StoredRun run = madeRun(one, cpu);
        runs.emplace(run.runId, std::move(run));
    }
    return runs;
}

/// Six repetitions of two methods: haze takes `ratio` times as long as fog, alternately `scatter` more and less in its
/// logarithm. Both drift together by 10 % a repetition.
inline std::vector<MadeRun> session(double fogMs, double ratio, const std::vector<int>& particles = {200, 1000},
                                    double scatter = 0.01, int seed = 1) {
    std::vector<MadeRun> made;
    for (const int count : particles)
        for (int k = 1; k <= 6; ++k) {
            const double fog = fogMs * count * std::pow(1.1, k);
            made.push_back({"fog", count, k, seed, fog});
            made.push_back({"haze", count, k, seed, fog * ratio * std::exp(k % 2 ? scatter : -scatter)});
        }
    return made;
}

/// The data of a folder.
inline ReportData readFolder(results::StoredRuns runs) {
    ReportData data;
    data.folder = "somewhere";
    data.writtenUtc = "2026-01-02T03:04:05Z";
    data.runs = std::move(runs);
    std::vector<const results::StoredRun*> all;
    for (const auto& [id, run] : data.runs) all.push_back(&run);
    RunGroup group = makeGroup(all, {});
    group.id = "other";
    data.groups.push_back(std::move(group));
    return data;
}

using LabelledRuns = std::pair<std::string, results::StoredRuns>;

inline MachineComparison compared(const std::vector<LabelledRuns>& machines) {
    std::vector<ReportData> folders;
    folders.reserve(machines.size());
    std::vector<std::string> labels;
    for (const auto& [label, runs] : machines) {
        folders.push_back(readFolder(runs));
        labels.push_back(label);
    }
    return comparisonOf(machineSet(std::move(folders), std::move(labels)));
}

/// The ratio of the frame times of haze to those of fog.
inline const MachineRatio& ratioOfHaze(const MachineComparison& comparison) {
    return comparison.experiments.at(0).ratios.at(0);
}

}  // namespace dustbench::report
