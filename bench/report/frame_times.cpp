#include "bench/report/frame_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/report/run_groups.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

FrameTimes condense(const std::vector<double>& frameMs) {
    FrameTimes times;
    times.frames = frameMs.size();
    if (frameMs.empty()) return times;
    const auto [minimum, maximum] = std::ranges::minmax(frameMs);
    times.minimumMs = minimum;
    // 2·∛n bins, Rice's rule: enough to reveal two speeds, few enough to smooth single frames.
    const auto wanted = static_cast<std::size_t>(std::lround(2 * std::cbrt(static_cast<double>(frameMs.size()))));
    const std::size_t bins = std::clamp(wanted, minimumBins, maximumBins);
    times.binMs = (maximum - minimum) / static_cast<double>(bins);
    times.bins.assign(times.binMs > 0 ? bins : 1, 0);
    for (const double ms : frameMs) {
        const auto bin = times.binMs > 0 ? static_cast<std::size_t>((ms - minimum) / times.binMs) : 0;
        ++times.bins[std::min(bin, times.bins.size() - 1)];
    }

    const std::size_t stretches = std::min(frameMs.size(), maximumTracePoints / 2);
    for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
        const std::size_t begin = stretch * frameMs.size() / stretches,
                          end = (stretch + 1) * frameMs.size() / stretches;
        std::size_t lowest = begin, highest = begin;
        for (std::size_t frame = begin; frame < end; ++frame) {
            if (frameMs[frame] < frameMs[lowest]) lowest = frame;
            if (frameMs[frame] > frameMs[highest]) highest = frame;
        }
        const auto [first, second] = std::minmax(lowest, highest);
        times.trace.emplace_back(first, frameMs[first]);
        if (second != first) times.trace.emplace_back(second, frameMs[second]);
    }
    return times;
}

void readFrameTimes(const std::filesystem::path& folder, ReportData& data) {
    struct Candidate {
        const StoredRun* run;
        std::string group, label;
    };
    std::vector<Candidate> candidates;
    std::set<const StoredRun*> known;
    for (const RunGroup& group : data.groups)
        for (const ReportCell& cell : group.cells)
            if (!cell.done.empty() && cell.done.front()->cells.contains("frame_ms_median") &&
                known.insert(cell.done.front()).second) {
                const std::string world = worldLabel(group, cell);
                candidates.push_back(
                    {cell.done.front(), group.id, variantLabel(group, cell) + (world.empty() ? "" : ", " + world)});
            }

    const std::size_t kept = std::min(candidates.size(), maximumRunsWithFrameTimes);
    data.runsWithoutFrameTimes = candidates.size() - kept;
    std::size_t unread = 0;
    std::string firstFault;
    for (std::size_t index = 0; index < kept; ++index) {
        const Candidate& candidate = candidates[index * candidates.size() / kept];
        const std::filesystem::path file = folder / "runs" / candidate.run->runId / "frames.csv";
        try {
            const auto table = files::CsvTable::parseFile(file);
            std::vector<double> frameMs;
            for (std::size_t row = 0; row < table.rows(); ++row) frameMs.push_back(table.number(row, "frame_ms"));
            FrameTimes times = condense(frameMs);
            times.runId = candidate.run->runId;
            times.group = candidate.group;
            times.label = candidate.label;
            data.frameTimes.push_back(std::move(times));
        } catch (const InputError& error) {
            if (unread++ == 0) firstFault = error.what();
        }
    }
    if (unread > 0)
        data.problems.push_back(
            fmt::format("frame times of {} runs cannot be read; the first error: {}", unread, firstFault));
}

}  // namespace dustbench::bench
