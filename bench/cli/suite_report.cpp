#include "bench/cli/suite_report.h"

#include <fmt/format.h>

#include "bench/cli/text_table.h"
#include "bench/suite/suite_fit.h"
#include "bench/suite/suite_verdicts.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

/// Tables of metrics with at most this many rows are transposed, because they are easier to read.
constexpr std::size_t maximumColumns = 6;

bench::TextRows transposed(const bench::TextRows& table) {
    bench::TextRows turned;
    turned.header.push_back("metric");
    for (const auto& row : table.rows) turned.header.push_back(row.front());
    for (std::size_t column = 1; column < table.header.size(); ++column) {
        turned.rows.push_back({table.header[column]});
        for (const auto& row : table.rows) turned.rows.back().push_back(row[column]);
    }
    return turned;
}

/// `invalid: ` and the text of saysInvalid; empty if all runs are valid.
std::string invalidLine(const std::vector<const bench::StoredRun*>& runs) {
    const std::string said = bench::saysInvalid(runs);
    return said.empty() ? "" : "invalid: " + files::printable(said) + "\n";
}

std::string textOf(bench::TextRows table) {
    table.rows.insert(table.rows.begin(), std::move(table.header));
    return textTable(table.rows);
}

}  // namespace

std::string suiteReport(const bench::Suite& suite, const bench::StoredRuns& runs) {
    const bool timed = bench::isTimed(suite, runs);
    std::string text =
        fmt::format("{}\n{}; {}\n", files::printable(suite.title),
                    timed ? "frames per second; ms per frame and per stage" : "not timed: counts and bytes",
                    suite.repetitions == 1 ? std::string("one run each")
                                           : fmt::format("medians over {} runs each", suite.repetitions));
    text += textOf(timed ? bench::tabulate(suite, runs) : bench::tabulateCounts(suite, runs));
    std::vector<const bench::StoredRun*> all;
    for (const bench::PlannedRun& cell : suite.cells) {
        const auto done = bench::doneRuns(cell, suite.repetitions, runs);
        all.insert(all.end(), done.begin(), done.end());
    }
    text += invalidLine(all);
    if (bench::TextRows metrics = bench::tabulateMetrics(suite, runs); !metrics.rows.empty())
        text += "\nmetrics, means over the compared frames (reports/METRICS.md)\n" +
                textOf(metrics.rows.size() <= maximumColumns ? transposed(metrics) : std::move(metrics));
    for (const bench::FitResult& fit : bench::fitSuite(suite, runs)) {
        text += fmt::format("\ngrowth with N = {}: a + b·N^k, 95 % intervals\n", fit.against);
        text += textOf(bench::tabulate(fit));
    }
    for (const bench::ComparisonResult& comparison : bench::suiteVerdicts(suite, runs)) {
        text += fmt::format("\n{} against {}: ratio of times, 95 % interval over paired runs\n", comparison.of,
                            comparison.with);
        text += textOf(bench::tabulate(comparison));
        for (const std::string& sentence : bench::conclusions(comparison)) text += files::printable(sentence) + "\n";
    }
    return text;
}

std::string runsReport(const std::string& title, const std::vector<bench::MeasuredCell>& cells) {
    std::vector<const bench::StoredRun*> all;
    for (const bench::MeasuredCell& cell : cells) all.insert(all.end(), cell.done.begin(), cell.done.end());
    return title + "\nframes per second; ms per frame and per stage; medians over the runs\n" +
           textOf(bench::tabulate(cells)) + invalidLine(all);
}

std::string publishedReport(bench::TextRows table) {
    return table.rows.empty() ? "" : "published numbers and ours\n" + textOf(std::move(table));
}

std::string claimsReport(const std::vector<bench::EvaluatedClaim>& claims) {
    if (claims.empty()) return "";
    return "claims\n" + textOf(bench::tabulate(claims));
}

}  // namespace dustbench::cli
