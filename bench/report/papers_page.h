// The index page of several reproduced papers: for each paper the verdicts, and the conditions under which they were
// measured. One self-contained HTML file that can be published with the papers' folders, which are next to it.
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
    std::string folder;  ///< folder of its page, relative to the index
    std::size_t runs = 0, runsDone = 0, runsWithWarnings = 0;
    std::string form;                       ///< `quick` or `full`
    std::vector<std::string> machines;      ///< `AMD EPYC, 2 cores, llvmpipe …`
    std::array<std::size_t, 6> verdicts{};  ///< by ClaimVerdict
};

/// `folder` is the report's, relative to the index.
[[nodiscard]] PaperLine lineOf(const ReportData& data, const Paper& paper, const std::string& folder);

[[nodiscard]] std::string papersPage(const std::vector<PaperLine>& lines);

/// Writes `folder`/index.html and returns its path. Throws InputError if it would replace a page that was not written
/// by this program.
std::filesystem::path writePapersPage(const std::filesystem::path& folder, const std::vector<PaperLine>& lines);

}  // namespace dustbench::bench
