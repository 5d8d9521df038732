// `dustbench report`: writes the page of a results folder, its tables as text, or one of its charts; or a page that
// compares the results of several machines.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <set>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/machines_text.h"
#include "bench/cli/suite_report.h"
#include "bench/report/chart_file.h"
#include "bench/report/machines/machine_comparison.h"
#include "bench/report/page.h"
#include "bench/report/report_reader.h"
#include "bench/report/run_groups.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

struct ReportOptions {
    std::vector<std::string> folders, labels;
    std::string chart, format, out;
    double pictureMegabytes = static_cast<double>(bench::defaultPictureBytes) / 1e6;
    bool text = false;
    std::vector<std::string> given;  ///< names of options
};

/// Throws if an option was given that applies only to one folder, or only to several.
void refuseOtherOptions(const ReportOptions& options) {
    static const std::set<std::string> ofOne{"--chart", "--format", "--pictures"}, ofSeveral{"--label"};
    const bool several = options.folders.size() > 1;
    for (const std::string& name : options.given)
        if ((several ? ofOne : ofSeveral).contains(name))
            throw InputError(fmt::format("{}: applies only to {}, not to {}", name,
                                         several ? "one folder" : "several folders, one for each machine",
                                         several ? "several folders" : "one folder"));
    if (options.text && !options.out.empty()) throw InputError("--text and --out: got both, allowed: one of them");
}

/// Table of runs that belong to no suite: those of `run` and `compare`, and of controls.
std::string runsOfNoSuite(const bench::RunGroup& group) {
    std::vector<bench::MeasuredCell> cells;
    for (const bench::ReportCell& cell : group.cells) {
        const std::string world = bench::worldLabel(group, cell);
        cells.push_back({bench::variantLabel(group, cell) + (world.empty() ? "" : ", " + world), cell.done});
    }
    return runsReport(group.title, cells);
}

/// Prints the tables of `suite` and `reproduce` for all existing runs.
void printTables(const bench::ReportData& data) {
    for (const bench::RunGroup& group : data.groups) {
        if (group.suite.empty()) {
            std::cout << group.id << ": " << runsOfNoSuite(group) << "\n";
            continue;
        }
        bench::Suite suite = bench::loadSuite(group.suite, group.id != group.suite);
        for (const bench::ReportCell& cell : group.cells)
            suite.repetitions = std::max(suite.repetitions, static_cast<int>(cell.done.size()));
        std::cout << group.id << ": " << suiteReport(suite, data.runs) << "\n";
    }
    std::cout << claimsReport(data.claims);
    for (const bench::NotDone& run : data.notDone)
        std::cout << fmt::format("{}: {}: {}\n", run.runId, run.status, files::printable(run.reason));
}

int reportMachines(const ReportOptions& options) {
    const bench::MachineComparison comparison =
        bench::comparisonOf(bench::readMachines({options.folders.begin(), options.folders.end()}, options.labels));
    const bench::MachineRemarks& remarks = comparison.remarks;
    if (!comparison.isComparable()) {
        for (const std::string& sentence : remarks.notes) std::cerr << "note: " << files::printable(sentence) << "\n";
        for (const std::string& sentence : remarks.apart)
            std::cerr << "not comparable: " << files::printable(sentence) << "\n";
        std::cerr << "not comparable: no configuration was measured on two machines\n";
        return exitNotComparable;
    }
    if (options.text) {
        std::cout << machinesText(comparison);
        return exitOk;
    }
    for (const auto* sentences : {&remarks.apart, &remarks.programs, &remarks.notes})
        for (const std::string& sentence : *sentences) std::cerr << "note: " << files::printable(sentence) << "\n";
    if (!remarks.missing.empty())
        std::cerr << fmt::format("note: {} not measured on every machine, see the list on the page\n",
                                 remarks.missing.size() == 1
                                     ? std::string("1 configuration was")
                                     : fmt::format("{} configurations were", remarks.missing.size()));
    std::cout << bench::writeMachinesPage(options.out.empty() ? "out/machines" : options.out, comparison).string()
              << "\n";
    return exitOk;
}

int report(const ReportOptions& options) {
    refuseOtherOptions(options);
    if (options.folders.size() > 1) return reportMachines(options);
    const std::string& folder = options.folders.front();
    if (!options.format.empty() && options.chart.empty())
        throw InputError("--format: got '" + options.format + "' without --chart, which it requires");
    if (options.text && !options.chart.empty()) throw InputError("--text and --chart: got both, allowed: one of them");
    const bool needsPictures = !options.text && options.chart.empty();
    const bench::ReportData data =
        bench::readReport(folder, needsPictures ? static_cast<std::int64_t>(options.pictureMegabytes * 1e6) : 0);
    for (const std::string& problem : data.problems) std::cerr << "note: " << files::printable(problem) << "\n";
    if (data.runs.empty())
        throw InputError(
            fmt::format("'{}': contains no readable run, expected a results folder written by `suite`, `run`, "
                        "`compare` or `reproduce`",
                        folder));
    if (options.text) {
        printTables(data);
    } else if (!options.chart.empty()) {
        for (const auto& file : bench::writeCharts(data, options.chart, {folder, options.out, options.format}))
            std::cout << file.string() << "\n";
    } else {
        std::cout << (options.out.empty() ? bench::writePage(folder, data)
                                          : bench::writePageTo(options.out, folder, data))
                         .string()
                  << "\n";
    }
    return exitOk;
}

}  // namespace

Command reportCommand() {
    auto options = std::make_shared<ReportOptions>();
    return {"report", "Write the report of a results folder, or one that compares several machines",
            "The report is a single file, DIR/index.html; a chart is DIR/charts/ID.svg. Nothing is written if DIR "
            "contains no run. A summary.csv alone is enough, with a machine.csv for the captions.\n"
            "Several folders: one page with ratios within each machine, hardware, claims, and remarks on\n"
            "comparability. Exit code 6: no configuration was measured on two machines; nothing is written.",
            [options](Arguments& arguments) {
                arguments.requiredTexts("dir", "DIR",
                                        "results folder written by `suite`, `run`, `compare` or `reproduce`; or "
                                        "several, one for each machine",
                                        options->folders);
                arguments.flag("--text", "print the tables instead of writing the report", options->text);
                arguments.text("--out", "FILE|DIR",
                               "a file that ends in .html (for a chart: .svg, .png or .pdf), or a folder; default: DIR "
                               "or DIR/charts; for several folders: out/machines",
                               options->out);
                arguments.texts("--label", "NAME",
                                "for several folders: a name for each, in their order; default: the "
                                "folders' names",
                                options->labels);
                arguments.text("--chart", "ID",
                               "write only one chart: a suite's id or its end (fig7), optionally with -stages or "
                               "-quality appended, a map of claims (by-voxel_edge), or frames; all: the chart of each "
                               "suite, and the maps",
                               options->chart);
                arguments.text("--format", "svg|png|pdf", "format of the chart; default: svg", options->format);
                arguments.number("--pictures", "megabytes of pictures in the report; any beyond that are linked",
                                 options->pictureMegabytes, 0, 1000);
                arguments.givenOptions(options->given);
            },
            [options] { return report(*options); }};
}

}  // namespace dustbench::cli
