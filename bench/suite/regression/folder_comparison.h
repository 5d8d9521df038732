// Compares two results folders: the ratio of the times of each configuration in B and A, and whether the folders are
// comparable.
//
// The folders were not measured interleaved, so repetitions are not paired (statistics.h). For all configurations
// together, each repetition of a folder gives one time, the geometric mean over the configurations, so that variation
// common to a round is counted once. A repetition counts only if all configurations have a time.
#pragma once

#include <string>
#include <vector>

#include "bench/measure/statistics.h"
#include "bench/suite/regression/folder_cells.h"

namespace dustbench::suite {

struct EvaluatedCell {
    const FolderCell* cell = nullptr;  ///< null: all configurations together
    std::string column;                ///< of summary.csv
    double aMs = 0, bMs = 0;           ///< geometric means; NaN if none. Rates count as time per frame
    measure::UnpairedRatio result;     ///< of B over A
    std::string reason;                ///< why there are not enough data for a verdict; empty if there are
};

/// Points into itself and into the sides: move it, and keep the sides alive.
struct FolderComparison {
    FolderComparison() = default;
    FolderComparison(FolderComparison&&) = default;
    FolderComparison& operator=(FolderComparison&&) = default;

    std::vector<FolderCell> cells;
    std::vector<std::string> axes;         ///< the fields that, with the method, identify a configuration
    std::vector<std::string> obstacles;    ///< why the folders cannot be compared, one sentence each; empty if they can
    std::vector<std::string> remarks;      ///< further notes: missing or failed runs, differences, disturbances
    std::vector<EvaluatedCell> evaluated;  ///< by column: the configurations in both folders, then all together
    /// Configurations done and valid in A without a failure that fail, time out or are invalid in B: whyBroken.
    std::vector<const FolderCell*> broken;
};

/// `acrossMachines`: also compares runs from different machines or builds. Throws InputError if a run does not contain
/// its key.
[[nodiscard]] FolderComparison compareFolders(const ResultsSide& a, const ResultsSide& b,
                                              const std::vector<std::string>& columns, bool acrossMachines);

/// `failed: …`, `timed out: …` or `invalid: …` for the first such run in B.
[[nodiscard]] std::string whyBroken(const FolderCell& cell);

/// True if there are enough runs and the whole interval is above 1 + percent/100.
[[nodiscard]] bool isSlowerBy(const EvaluatedCell& evaluated, double percent);

}  // namespace dustbench::suite
