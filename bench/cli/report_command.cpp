// `dustbench report`: the page of a results folder, its tables for a terminal, or one of its charts as a file.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/suite_report.h"
#include "bench/report/chart_file.h"
#include "bench/report/page.h"
#include "bench/report/report_reader.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

struct ReportOptions {
    std::string folder, chart, format;
    double pictureMegabytes = static_cast<double>(bench::defaultPictureBytes) / 1e6;
    bool text = false;
};

/// The tables printed by `suite` and `reproduce`, for all existing runs.
void printTables(const bench::ReportData& data) {
    for (const bench::RunGroup& group : data.groups) {
        if (group.suite.empty()) continue;
        bench::Suite suite = bench::loadSuite(group.suite, group.id != group.suite);
        for (const bench::ReportCell& cell : group.cells)
            suite.repetitions = std::max(suite.repetitions, static_cast<int>(cell.done.size()));
        std::cout << group.id << ": " << suiteReport(suite, data.runs) << "\n";
    }
    std::cout << claimsReport(data.claims);
}

int report(const ReportOptions& options) {
    if (!options.format.empty() && options.chart.empty())
        throw InputError("--format: got '" + options.format + "' without --chart, which it belongs to");
    if (options.text && !options.chart.empty()) throw InputError("--text and --chart: got both, allowed: one of them");
    const bool needsPictures = !options.text && options.chart.empty();
    const bench::ReportData data = bench::readReport(
        options.folder, needsPictures ? static_cast<std::int64_t>(options.pictureMegabytes * 1e6) : 0);
    for (const std::string& problem : data.problems) std::cerr << "note: " << files::printable(problem) << "\n";
    if (data.runs.empty())
        throw InputError(
            fmt::format("'{}': holds no run that can be read, expected a folder that `suite`, `run`, "
                        "`compare` or `reproduce` wrote",
                        options.folder));
    if (options.text) {
        printTables(data);
    } else if (!options.chart.empty()) {
        const std::string format = options.format.empty() ? "svg" : options.format;
        std::cout << bench::writeChart(options.folder, data, options.chart, format).string() << "\n";
    } else {
        std::cout << bench::writePage(options.folder, data).string() << "\n";
    }
    return exitOk;
}

}  // namespace

Command reportCommand() {
    auto options = std::make_shared<ReportOptions>();
    return {"report", "Write the report of a result folder: charts, pictures, claims, machine",
            "The report is DIR/index.html, one file; a chart is DIR/charts/ID.svg. Without a run in DIR nothing is "
            "written.",
            [options](Arguments& arguments) {
                arguments.required("dir", "DIR", "a folder that `suite`, `run`, `compare` or `reproduce` wrote",
                                   options->folder);
                arguments.flag("--text", "print the tables instead of writing the report", options->text);
                arguments.text("--chart", "ID",
                               "one chart alone: a suite's id or its end (fig7), -stages or -quality "
                               "behind it, or frames",
                               options->chart);
                arguments.text("--format", "svg|png|pdf", "of the chart; default: svg", options->format);
                arguments.number("--pictures", "megabytes of pictures in the report; further ones are linked",
                                 options->pictureMegabytes, 0, 1000);
            },
            [options] { return report(*options); }};
}

}  // namespace dustbench::cli
