// Measures again what alerts in a comparison of two result folders, so that chance alone does not fail it.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bench/suite/regression/folder_comparison.h"

namespace dustbench::cli {

/// A comparison that alerts: a column of a cell, or of all cells together (null).
struct Alert {
    const bench::FolderCell* cell;
    std::string column;
};

class SecondLook {
 public:
    /// Measures the cells of `alerts` once more with this program, each as often as it was in B, and compares them with
    /// A. The runs are written to `folder`. Where B is of another build, or its inputs have changed, nothing is
    /// measured (whyNot).
    SecondLook(const bench::ResultsSide& a, const bench::FolderComparison& first, const std::vector<Alert>& alerts,
               double percent, const std::filesystem::path& folder);

    /// Empty if it was measured.
    [[nodiscard]] const std::string& whyNot() const { return whyNot_; }
    [[nodiscard]] bool aborted() const { return aborted_; }
    /// What the alert became: null if it could not be judged again.
    [[nodiscard]] const bench::JudgedCell* judged(const Alert& alert) const;
    /// True if it alerts again, or could not be judged again.
    [[nodiscard]] bool confirms(const Alert& alert) const;

 private:
    double percent_;
    std::string whyNot_;
    bool aborted_ = false;
    bench::ResultsSide a_, b_;
    bench::FolderComparison comparison_;
};

}  // namespace dustbench::cli
