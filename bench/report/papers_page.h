// The index of several papers that were reproduced into folders side by side: for each its verdicts, and how far to
// trust them. One self-contained HTML file, fit to be published with the folders.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// A paper's line in the index.
struct PaperLine {
    std::string citation, venue;
    std::string folder;  ///< of its page, relative to the index
    std::size_t runs = 0, runsDone = 0, runsWithWarnings = 0;
    std::string form;                       ///< `quick` or `whole`
    std::vector<std::string> machines;      ///< `AMD EPYC, 2 cores, llvmpipe …`
    std::array<std::size_t, 6> verdicts{};  ///< by ClaimVerdict
};

/// `folder` is that of the report, relative to the index.
[[nodiscard]] PaperLine lineOf(const ReportData& data, const Paper& paper, const std::string& folder);

[[nodiscard]] std::string papersPage(const std::vector<PaperLine>& lines);

/// Writes `folder`/index.html and returns its path. Throws InputError if there is a page not written by this program.
std::filesystem::path writePapersPage(const std::filesystem::path& folder, const std::vector<PaperLine>& lines);

}  // namespace dustbench::bench
