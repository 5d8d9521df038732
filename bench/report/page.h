// The pages of results: the report of a folder, the index of several reproduced papers, and the templates that they are
// made from. Each page is one self-contained HTML file, which needs no network and no other file.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::report {

/// `David N. Carr, Jim Geyer (2006): Variants of …`
[[nodiscard]] std::string citationOf(const suite::Paper& paper);

/// The report.
[[nodiscard]] std::string pageOf(const ReportData& data);

/// Writes `folder`/index.html, and claims.csv if there are claims, and returns the page's path. Throws InputError if it
/// would replace a page that was not written by this program.
std::filesystem::path writePage(const std::filesystem::path& folder, const ReportData& data);

/// Writes only the page, to `out`, a file that ends in `.html`, or to index.html in a folder, which is created if
/// missing. Its links lead to `folder`. Returns its path.
std::filesystem::path writePageTo(const std::filesystem::path& out, const std::filesystem::path& folder,
                                  ReportData data);

/// A paper's line in the index: its verdicts, and the conditions under which they were measured.
struct PaperLine {
    std::string citation, venue;
    std::string folder;  ///< folder of its page, relative to the index
    std::size_t runs = 0, runsDone = 0, runsWithWarnings = 0;
    std::string form;                       ///< `quick` or `full`
    std::vector<std::string> machines;      ///< `AMD EPYC, 2 cores, llvmpipe …`
    std::array<std::size_t, 6> verdicts{};  ///< by ClaimVerdict
};

/// `folder` is the report's, relative to the index.
[[nodiscard]] PaperLine lineOf(const ReportData& data, const suite::Paper& paper, const std::string& folder);

/// The index. It can be published with the papers' folders, which are next to it.
[[nodiscard]] std::string papersPage(const std::vector<PaperLine>& lines);

/// Writes `folder`/index.html and returns its path. Throws InputError if it would replace a page that was not written
/// by this program.
std::filesystem::path writePapersPage(const std::filesystem::path& folder, const std::vector<PaperLine>& lines);

// --- Templates, also of other pages and scripts

/// `text` as the content of an element.
[[nodiscard]] std::string escaped(std::string_view text);

/// Replaces each `{{name}}`. Inserted text is not expanded. Throws std::out_of_range for an unknown name.
[[nodiscard]] std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& parts);

/// Throws InputError if `folder` contains such a file that was not written by this program.
void requireOwnPage(const std::filesystem::path& folder, std::string_view name = "index.html");

}  // namespace dustbench::report
