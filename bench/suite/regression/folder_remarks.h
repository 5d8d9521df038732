// Remarks on two results folders: why they cannot be compared, and differences other than times.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/regression/folder_cells.h"

namespace dustbench::bench {

/// Each sentence is one line. Keeps references.
class FolderRemarks {
 public:
    FolderRemarks(const ResultsSide& a, const ResultsSide& b, const std::vector<FolderCell>& cells,
                  const std::vector<std::string>& distinguishingNames)
        : a_(a), b_(b), cells_(cells), distinguishingNames_(distinguishingNames) {}

    /// No common configuration, only copied runs, or configurations whose runs did different work: other inputs, or a
    /// different final state.
    [[nodiscard]] std::vector<std::string> obstacles() const;
    /// Configurations whose runs are from different machines or builds.
    [[nodiscard]] std::vector<std::string> machines() const;
    /// Runs in only one folder, failed and invalid runs, runs from debug builds or with warnings, and other differences
    /// between the two programs.
    [[nodiscard]] std::vector<std::string> rest() const;

 private:
    [[nodiscard]] std::string nothingInCommon() const;
    /// The number of runs that were copied between the folders, as a sentence; empty if there are none.
    [[nodiscard]] std::string copies() const;
    [[nodiscard]] std::string nameOf(const FolderCell& cell) const { return labelOf(cell, distinguishingNames_); }

    const ResultsSide& a_;
    const ResultsSide& b_;
    const std::vector<FolderCell>& cells_;
    const std::vector<std::string>& distinguishingNames_;
};

}  // namespace dustbench::bench
