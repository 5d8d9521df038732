// Puts the runs of several results folders, such as the shards of a suite, into one: the rows are those of one machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/results/results_folder.h"
#include "bench/results/stored_run.h"

namespace dustbench::bench {

struct MergePlan {
    struct Copy {
        std::string runId;
        std::filesystem::path from;
    };
    std::vector<Copy> copies;
    std::size_t there = 0;  ///< runs of the sources that need no copy: in the results, or in a source before
    std::uintmax_t bytes = 0;
};

/// A results folder and what readStoredRuns found in it.
using MergeSource = std::pair<std::filesystem::path, StoredRuns>;

/// Looks at everything before anything is written. One result of a run is enough where all are equal (the same run.json
/// byte by byte, the same files by name and size). Throws InputError with the folder where one is missing or a run in
/// it cannot be read, and with both places where there are two results of one run.
[[nodiscard]] MergePlan planMerge(const std::vector<MergeSource>& sources, const ResultsFolder& results);

/// Throws InputError with both numbers where the copies do not fit.
void requireSpace(const MergePlan& plan, const std::filesystem::path& folder, std::uintmax_t availableBytes);

/// Copies run by run; each appears by one rename, so that a kill loses none and the same command goes on. `interrupted`
/// is asked between runs; false: it was. Throws InputError with the file that cannot be copied.
[[nodiscard]] bool merge(const MergePlan& plan, ResultsFolder& results, const std::function<bool()>& interrupted);

}  // namespace dustbench::bench
