// Groups the runs of two results folders into configurations (cells): runs that differ only in the repetition.
#pragma once

#include <string>
#include <vector>

#include "bench/results/compared_runs.h"
#include "bench/suite/suite_cells.h"

namespace dustbench::suite {

struct ResultsSide {
    std::string name;  ///< for messages: the folder as given
    results::StoredRuns runs;
};

/// The runs of one configuration in one folder. Points into the folder's runs.
struct CellRuns {
    std::vector<const results::StoredRun*> done;     ///< and valid
    std::vector<const results::StoredRun*> invalid;  ///< done, but unusable for verdicts
    std::vector<const results::StoredRun*> copied;   ///< the same measurement as a run in the other folder
    std::vector<const results::StoredRun*> failed;   ///< including timeouts
    std::vector<const results::StoredRun*> skipped;  ///< the method does not support the scene
    [[nodiscard]] std::size_t count() const {
        return done.size() + invalid.size() + copied.size() + failed.size() + skipped.size();
    }
};

/// The fields that identify a configuration, in the order of the run's key: `method`, `scene`, `drive`, `p.particles`,
/// `frames` …
using CellIdentity = results::KeyFields;
/// Empty if there is no such field.
[[nodiscard]] std::string valueOf(const CellIdentity& identity, const std::string& name);
/// Field by field; numbers numerically.
[[nodiscard]] bool identityLess(const CellIdentity& a, const CellIdentity& b);

/// Adds a run to the list for its status and validity.
void add(CellRuns& runs, const results::StoredRun& run);

struct FolderCell {
    CellIdentity identity;
    CellRuns a, b;
    /// Empty if there is no such field.
    [[nodiscard]] std::string valueOf(const std::string& name) const { return suite::valueOf(identity, name); }
};

/// Ignores which frames get metrics: metrics are computed after the timed frames, in the first repetition only. Throws
/// InputError if a run does not contain its key.
[[nodiscard]] CellIdentity identityOf(const results::StoredRun& run);

/// Sorted by identityLess. A run and its copy in the other folder are `copied`, not `done`.
[[nodiscard]] std::vector<FolderCell> cellsOf(const ResultsSide& a, const ResultsSide& b);

/// The fields needed in addition to the method to tell configurations apart: those with several values in one method.
[[nodiscard]] std::vector<std::string> distinguishingNames(const std::vector<CellIdentity>& cells);
[[nodiscard]] std::vector<std::string> distinguishingNames(const std::vector<FolderCell>& cells);

/// `billboard particles=500 sort=none`
[[nodiscard]] std::string labelOf(const CellIdentity& identity, const std::vector<std::string>& distinguishingNames);
[[nodiscard]] std::string labelOf(const FolderCell& cell, const std::vector<std::string>& distinguishingNames);

}  // namespace dustbench::suite
