// The runs of two results folders, sorted into cells: runs that are equal in everything but the repetition.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/suite/cell_results.h"

namespace dustbench::bench {

struct ResultsSide {
    std::string name;  ///< for people: the folder as it was given
    StoredRuns runs;
};

/// One cell's runs of one folder. Points into it.
struct CellRuns {
    std::vector<const StoredRun*> done;
    std::vector<const StoredRun*> failed;   ///< and those that ran out of time
    std::vector<const StoredRun*> skipped;  ///< the method cannot take the scene
    [[nodiscard]] std::size_t count() const { return done.size() + failed.size() + skipped.size(); }
};

/// What tells a cell from others, in the order of the run's key: `method`, `scene`, `drive`, `p.particles`, `frames` …
using CellIdentity = std::vector<std::pair<std::string, std::string>>;

struct FolderCell {
    CellIdentity identity;
    CellRuns a, b;
    /// Empty where the cell has no such thing.
    [[nodiscard]] std::string valueOf(const std::string& name) const;
};

/// Which frames get metrics is not part of a cell: that happens after the timed frames, in the first repetition alone.
/// Throws InputError where a run does not say what it was.
[[nodiscard]] CellIdentity identityOf(const StoredRun& run);

/// By identity, numbers in their order.
[[nodiscard]] std::vector<FolderCell> cellsOf(const ResultsSide& a, const ResultsSide& b);

/// What must be named beside the method to tell the cells apart: what takes several values among those of one method.
[[nodiscard]] std::vector<std::string> tellingNames(const std::vector<FolderCell>& cells);

/// `billboard particles=500 sort=none`
[[nodiscard]] std::string labelOf(const FolderCell& cell, const std::vector<std::string>& tellingNames);

}  // namespace dustbench::bench
