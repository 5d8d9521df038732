// Measures suspected regressions of a folder comparison again, so that chance alone does not fail it.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bench/suite/regression/folder_comparison.h"

namespace dustbench::cli {

/// A suspected regression: a column of one configuration, or of all together (null).
struct Alert {
    const bench::FolderCell* cell;
    std::string column;
};

class SecondLook {
 public:
    /// Measures the configurations of `alerts` again with this program, each as often as in B, and compares them with
    /// A. The runs are written to `folder`. Measures nothing if B is from another build or its inputs have changed
    /// (whyNot).
    SecondLook(const bench::ResultsSide& a, const bench::FolderComparison& first, const std::vector<Alert>& alerts,
               double percent, const std::filesystem::path& folder);

    /// Empty if it was measured.
    [[nodiscard]] const std::string& whyNot() const { return whyNot_; }
    [[nodiscard]] bool aborted() const { return aborted_; }
    /// The alert's result in the second measurement; null if there is none.
    [[nodiscard]] const bench::EvaluatedCell* evaluated(const Alert& alert) const;
    /// True if the second measurement alerts again or could not decide.
    [[nodiscard]] bool confirms(const Alert& alert) const;

 private:
    double percent_;
    std::string whyNot_;
    bool aborted_ = false;
    bench::ResultsSide a_, b_;
    bench::FolderComparison comparison_;
};

}  // namespace dustbench::cli
