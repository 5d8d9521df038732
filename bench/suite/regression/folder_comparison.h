// Two results folders against each other: each cell's times in B over those in A, and whether they can be compared.
//
// The two were not measured by turns, so no repetition has a partner (unpaired_ratio.h). All cells together: each
// repetition of a folder gives one time, the geometric mean over the cells, so that what a round has in common counts
// as what it is; a repetition counts where all cells have a time.
#pragma once

#include <string>
#include <vector>

#include "bench/measure/unpaired_ratio.h"
#include "bench/suite/regression/folder_cells.h"

namespace dustbench::bench {

struct JudgedCell {
    const FolderCell* cell = nullptr;  ///< null: all together
    std::string column;                ///< of summary.csv
    double aMs = 0, bMs = 0;           ///< geometric means; NaN for none. Rates count as time per frame
    UnpairedRatio result;              ///< of B over A
    std::string reason;                ///< why too little is there for a verdict; empty where it is not so
};

/// Points into itself and into the sides: move it, and keep them.
struct FolderComparison {
    FolderComparison() = default;
    FolderComparison(FolderComparison&&) = default;

    std::vector<FolderCell> cells;
    std::vector<std::string> axes;       ///< what tells the cells apart beside their method
    std::vector<std::string> obstacles;  ///< why the folders cannot be compared, one sentence each; empty: they can
    std::vector<std::string> remarks;    ///< what else should be known: what is missing, failed, differs or disturbed
    std::vector<JudgedCell> judged;      ///< column by column: the cells that are in both, then all together
    /// Cells that are done in A without a failure, and fail or run out of time in B.
    std::vector<const FolderCell*> broken;
};

/// `acrossMachines`: runs of different machines or builds are compared all the same. Throws InputError where a run
/// does not say what it was.
[[nodiscard]] FolderComparison compareFolders(const ResultsSide& a, const ResultsSide& b,
                                              const std::vector<std::string>& columns, bool acrossMachines);

/// True where enough runs are there and the whole interval lies above 1 + percent/100.
[[nodiscard]] bool isSlowerBy(const JudgedCell& judged, double percent);

}  // namespace dustbench::bench
