// Merges the runs of several results folders, such as the shards of a suite, into one. All runs should be from one
// machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/results/results_folder.h"
#include "bench/results/stored_run.h"

namespace dustbench::results {

struct MergePlan {
    struct Copy {
        std::string runId;
        std::filesystem::path from;
    };
    std::vector<Copy> copies;
    std::size_t there = 0;  ///< runs of the sources that are already in the results or in an earlier source
    std::uintmax_t bytes = 0;
};

/// A results folder and the runs that readStoredRuns found in it.
using MergeSource = std::pair<std::filesystem::path, StoredRuns>;

/// Checks everything before writing anything. Equal results of a run (same run.json byte by byte, same files by name
/// and size) count once. Throws InputError with the folder if it is missing or contains an unreadable run, with both
/// places if a run has two different results, and with the path of a link, pipe or device below a source.
[[nodiscard]] MergePlan planMerge(const std::vector<MergeSource>& sources, const ResultsFolder& results);

/// Throws InputError with both sizes if the copies do not fit on the disk.
void requireSpace(const MergePlan& plan, const std::filesystem::path& folder, std::uintmax_t availableBytes);

/// Copies run by run. Each run appears by one rename, so an interrupted merge loses nothing; repeat it to continue.
/// `interrupted` is called between runs; returns false if it returned true. Throws InputError with the file that cannot
/// be copied.
[[nodiscard]] bool merge(const MergePlan& plan, ResultsFolder& results, const std::function<bool()>& interrupted);

}  // namespace dustbench::results
