// `dustbench report`: writes the page of a results folder, its tables as text, or one of its charts; or a page that
// compares the results of several machines.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <set>
#include <string>

#include "bench/cli/commands.h"
#include "bench/cli/suite_report.h"
#include "bench/cli/text_table.h"
#include "bench/report/chart_file.h"
#include "bench/report/machines/machine_comparison.h"
#include "bench/report/page.h"
#include "bench/report/report_reader.h"
#include "bench/report/run_groups.h"
#include "bench/suite/suite_table.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

using measure::PairedRatio;
using report::MachineComparison;
using report::MachineExperiment;

// --- The comparison of several machines as text

/// Longer lists end with the number of further items.
constexpr std::size_t namedCells = 20;

/// Shortens values that do not fit into a column.
std::string shortened(const std::string& text) {
    constexpr std::size_t longest = 60;
    return files::printable(text, longest);
}

std::vector<std::string> heads(std::vector<std::string> first, const std::vector<std::string>& labels,
                               std::vector<std::string> last = {}) {
    first.insert(first.end(), labels.begin(), labels.end());
    first.insert(first.end(), last.begin(), last.end());
    return first;
}

std::vector<std::string> labelsOf(const report::MachineComparison& comparison) {
    std::vector<std::string> labels;
    labels.reserve(comparison.set.sides.size());
    for (const report::MachineSide& side : comparison.set.sides) labels.push_back(side.label);
    return labels;
}

std::string hardwareText(const report::MachineComparison& comparison) {
    std::vector<std::vector<std::string>> rows{heads({""}, labelsOf(comparison))};
    for (const report::HardwareRow& row : comparison.hardware) {
        rows.push_back({row.name});
        for (const std::string& value : row.values) rows.back().push_back(shortened(value.empty() ? "unknown" : value));
    }
    return textTable(rows);
}

std::string listOf(const std::string& head, const std::vector<std::string>& sentences) {
    if (sentences.empty()) return "";
    std::string text = "\n" + head + "\n";
    for (const std::string& sentence : sentences) text += "  " + files::printable(sentence) + "\n";
    return text;
}

std::vector<std::string> missingCells(const report::MachineComparison& comparison) {
    std::vector<std::string> sentences;
    for (const report::MissingCell& missing : comparison.remarks.missing) {
        if (sentences.size() == namedCells) {
            sentences.push_back(fmt::format("and {} more", comparison.remarks.missing.size() - namedCells));
            break;
        }
        std::vector<std::string> lacking;
        lacking.reserve(missing.lacking.size());
        for (const auto& [side, why] : missing.lacking)
            lacking.push_back(fmt::format("{} on {}", why, comparison.set.sides[side].label));
        sentences.push_back(fmt::format("{}: {}", missing.cell, fmt::join(lacking, "; ")));
    }
    return sentences;
}

/// Ratios far from 1 have three significant digits.
std::string digits(double ratio) {
    return std::isfinite(ratio) && (ratio < 0.1 || ratio >= 1e5) ? fmt::format("{:.3g}", ratio)
                                                                 : suite::fourDigits(ratio);
}

/// `0.812 [0.79, 0.83] FASTER`
std::string ratioText(const report::SideRatio& side, bool invert) {
    const measure::PairedRatio ratio = invert ? report::inverted(side.result) : side.result;
    if (ratio.pairs == 0) return side.reason;
    if (ratio.pairs == 1) return fmt::format("{} (one run)", digits(ratio.ratio));
    return fmt::format("{} [{}, {}] {}", digits(ratio.ratio), digits(ratio.low), digits(ratio.high),
                       measure::verdictName(ratio.verdict));
}

std::string experimentText(const report::MachineComparison& comparison, const report::MachineExperiment& experiment) {
    std::vector<std::vector<std::string>> rows;
    const auto addRow = [&](const report::MachineRatio& ratio, const std::string& world, const report::RatioRow& row) {
        const bool invert = ratio.of == experiment.reference;
        std::vector<std::string> cells{ratio.column, experiment.variants[invert ? ratio.with : ratio.of].label, world};
        for (const report::SideRatio& side : row.sides) cells.push_back(ratioText(side, invert));
        cells.emplace_back(report::agreementText(report::agreementOf(row.sides)));
        rows.push_back(std::move(cells));
    };
    for (const report::MachineRatio& ratio : experiment.ratios) {
        if (ratio.of != experiment.reference && ratio.with != experiment.reference) continue;
        for (const report::RatioRow& row : ratio.worlds) addRow(ratio, report::worldLabel(experiment, row.world), row);
        if (ratio.worlds.size() > 1) addRow(ratio, fmt::format("all {} in common", ratio.common), ratio.all);
    }
    if (rows.empty())
        return fmt::format("\n{}: no ratio: no world has times of two methods or settings\n",
                           files::printable(experiment.title));
    rows.insert(rows.begin(), heads({"column", "of", "at"}, labelsOf(comparison), {"machines"}));
    return fmt::format("\n{}\nratio of times to those of {}, within each machine, 95 % interval over paired runs\n{}",
                       files::printable(experiment.title),
                       files::printable(experiment.variants[experiment.reference].label), textTable(rows));
}

std::string claimsText(const report::MachineComparison& comparison) {
    if (comparison.claims.empty()) return "";
    std::vector<std::vector<std::string>> rows{heads({"paper", "id"}, comparison.set.labels, {"machines", "claim"})};
    for (const report::SharedClaim& claim : comparison.claims) {
        rows.push_back({claim.any().paper, claim.any().claim.id});
        for (const claims::EvaluatedClaim* evaluated : claim.folders)
            rows.back().push_back(evaluated ? claims::verdictText(*evaluated) : "–");
        rows.back().emplace_back(report::agreementText(claim.agreement));
        rows.back().push_back(shortened(claim.any().claim.text));
    }
    return "\nclaims\n" + textTable(rows);
}

std::string machinesText(const report::MachineComparison& comparison) {
    const report::MachineRemarks& remarks = comparison.remarks;
    std::string text = hardwareText(comparison);
    text += listOf("cannot be compared", remarks.apart);
    text += listOf("the programs differ, so ratios may differ for reasons other than the machines", remarks.programs);
    text += listOf("notes", remarks.notes);
    text += listOf("missing configurations", missingCells(comparison));
    for (const report::MachineExperiment& experiment : comparison.experiments)
        text += experimentText(comparison, experiment);
    return text + claimsText(comparison);
}

// --- The command

struct ReportOptions {
    std::vector<std::string> folders, labels;
    std::string chart, format, out;
    double pictureMegabytes = static_cast<double>(report::defaultPictureBytes) / 1e6;
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
std::string runsOfNoSuite(const report::RunGroup& group) {
    std::vector<suite::MeasuredCell> cells;
    for (const report::ReportCell& cell : group.cells) {
        const std::string world = report::worldLabel(group, cell);
        cells.push_back({report::variantLabel(group, cell) + (world.empty() ? "" : ", " + world), cell.done});
    }
    return runsReport(group.title, cells);
}

/// Prints the tables of `suite` and `reproduce` for all existing runs.
void printTables(const report::ReportData& data) {
    for (const report::RunGroup& group : data.groups) {
        if (group.suite.empty()) {
            std::cout << group.id << ": " << runsOfNoSuite(group) << "\n";
            continue;
        }
        suite::Suite suite = suite::loadSuite(group.suite, group.id != group.suite);
        for (const report::ReportCell& cell : group.cells)
            suite.repetitions = std::max(suite.repetitions, static_cast<int>(cell.done.size()));
        std::cout << group.id << ": " << suiteReport(suite, data.runs) << "\n";
    }
    std::cout << claimsReport(data.claims);
    for (const report::NotDone& run : data.notDone)
        std::cout << fmt::format("{}: {}: {}\n", run.runId, run.status, files::printable(run.reason));
}

int reportMachines(const ReportOptions& options) {
    const report::MachineComparison comparison =
        report::comparisonOf(report::readMachines({options.folders.begin(), options.folders.end()}, options.labels));
    const report::MachineRemarks& remarks = comparison.remarks;
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
    std::cout << report::writeMachinesPage(options.out.empty() ? "out/machines" : options.out, comparison).string()
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
    const report::ReportData data =
        report::readReport(folder, needsPictures ? static_cast<std::int64_t>(options.pictureMegabytes * 1e6) : 0);
    for (const std::string& problem : data.problems) std::cerr << "note: " << files::printable(problem) << "\n";
    if (data.runs.empty())
        throw InputError(
            fmt::format("'{}': contains no readable run, expected a results folder written by `suite`, `run`, "
                        "`compare` or `reproduce`",
                        folder));
    if (options.text) {
        printTables(data);
    } else if (!options.chart.empty()) {
        for (const auto& file : report::writeCharts(data, options.chart, {folder, options.out, options.format}))
            std::cout << file.string() << "\n";
    } else {
        std::cout << (options.out.empty() ? report::writePage(folder, data)
                                          : report::writePageTo(options.out, folder, data))
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
