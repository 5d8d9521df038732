// What is to be said of two results folders beside their times: why they cannot be compared, or what should be known.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/regression/folder_cells.h"

namespace dustbench::bench {

/// All sentences are one line. Keeps references.
class FolderRemarks {
 public:
    FolderRemarks(const ResultsSide& a, const ResultsSide& b, const std::vector<FolderCell>& cells,
                  const std::vector<std::string>& tellingNames)
        : a_(a), b_(b), cells_(cells), tellingNames_(tellingNames) {}

    /// No cell in both, or cells whose runs did not do the same work: other inputs, or another state in the end.
    [[nodiscard]] std::vector<std::string> obstacles() const;
    /// Cells whose runs are of different machines or builds.
    [[nodiscard]] std::vector<std::string> machines() const;
    /// What is in one folder only, did not end well, was measured by a build for debugging or under warnings, and what
    /// else differs between the two programs.
    [[nodiscard]] std::vector<std::string> rest() const;

 private:
    [[nodiscard]] std::string nothingInCommon() const;
    [[nodiscard]] std::string nameOf(const FolderCell& cell) const { return labelOf(cell, tellingNames_); }

    const ResultsSide& a_;
    const ResultsSide& b_;
    const std::vector<FolderCell>& cells_;
    const std::vector<std::string>& tellingNames_;
};

}  // namespace dustbench::bench
