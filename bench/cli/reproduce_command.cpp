// `dustbench reproduce`: runs the suites and experiments of a paper, prints the results and writes its page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <vector>

#include "bench/claims/claim_ledger.h"
#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/suite_report.h"
#include "bench/report/page.h"
#include "bench/report/published_points.h"
#include "bench/report/report_reader.h"
#include "bench/run/progress.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

struct ReproduceOptions {
    std::string paper, out;
    bool quick = false, full = false, controls = false, dryRun = false;
};

struct SuiteWork {
    suite::Suite suite;
    std::vector<suite::PlannedRun> plan;
    PlanOptions options;
};

struct PaperWork {
    suite::Paper paper;
    std::unique_ptr<results::ResultsFolder> results;
    std::vector<SuiteWork> suites;
    std::size_t published = 0;  ///< number of published points on the paper's charts
    bool quick = false;         ///< reduced suites and experiments
};

/// The folder that contains one folder per paper, if a call reproduces several.
std::filesystem::path folderOfAll(const ReproduceOptions& options) {
    return options.out.empty() ? std::filesystem::path("reports/out") : std::filesystem::path(options.out);
}

/// Reads all input files first, so that an error in the last paper is found before the first run.
std::vector<PaperWork> gatherWork(const ReproduceOptions& options) {
    std::vector<PaperWork> work;
    for (const std::string& id : options.paper.empty() ? suite::listPapers() : std::vector{options.paper}) {
        PaperWork& paper = work.emplace_back();
        paper.paper = suite::loadPaper(id);
        paper.quick = options.quick;
        (void)claims::loadClaims(id);
        for (const auto& [suite, points] : report::readPublished(id)) paper.published += points.size();
        std::vector<std::string> suites = paper.paper.suites;
        if (options.controls) std::ranges::copy(paper.paper.controls, std::back_inserter(suites));
        for (const std::string& suite : suites) {
            SuiteWork& each = paper.suites.emplace_back();
            each.suite = suite::loadSuite(suite, options.quick);
            each.plan = suite::planRuns(each.suite);
            checkWorlds(each.plan);
            each.options.timeoutSeconds = each.suite.timeoutSeconds;
            each.options.limits = each.suite.limits;
            each.options.cooldownSeconds = each.suite.cooldownSeconds;
        }
    }
    return work;
}

void openFolders(const ReproduceOptions& options, std::vector<PaperWork>& work) {
    if (options.paper.empty()) report::requireOwnPage(folderOfAll(options));
    for (PaperWork& paper : work) {
        std::filesystem::path out = options.out;
        if (options.out.empty() || options.paper.empty()) out = folderOfAll(options) / paper.paper.id;
        report::requireOwnPage(out);
        paper.results = std::make_unique<results::ResultsFolder>(out);
    }
}

/// Lists the runs that would be measured, and the number of published points on their charts.
void printWork(const std::vector<PaperWork>& work) {
    const auto counted = [](std::size_t count, const std::string& one) {
        return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
    };
    for (const PaperWork& paper : work) {
        std::cout << fmt::format(
            "{}: {}, {}, {} on its charts\n", paper.paper.id, counted(paper.suites.size(), "suite"),
            counted(paper.paper.experiments.size(), "experiment"), counted(paper.published, "published number"));
        for (const SuiteWork& each : paper.suites)
            std::cout << fmt::format("    {}: {}\n", each.suite.id, counted(each.plan.size(), "run"));
    }
}

/// Prints how long the remaining runs will take; false if interrupted.
bool sayHowLong(std::vector<PaperWork>& work) {
    std::cerr << "estimate: starting one run of each configuration" << std::endl;
    std::size_t runs = 0;
    double seconds = 0;
    for (PaperWork& paper : work)
        for (SuiteWork& each : paper.suites) {
            const run::PlanForecast forecast = forecastRuns(each.plan, *paper.results, each.options);
            if (forecast.aborted) return false;
            for (const std::string& warning : forecast.warnings)
                std::cerr << "warning: " << each.suite.id << ": " << files::printable(warning) << std::endl;
            std::cerr << fmt::format("    {}: {} runs, {}", each.suite.id, forecast.runs,
                                     run::durationText(forecast.seconds))
                      << std::endl;
            runs += forecast.runs;
            seconds += forecast.seconds;
        }
    std::cerr << fmt::format("estimate: {} for {} runs, excluding the papers' experiments that follow",
                             run::durationText(seconds), runs)
              << std::endl;
    return true;
}

/// The quantities that experiments could not measure, one line each.
std::string notMeasured(const std::vector<claims::StoredFinding>& findings) {
    std::string lines;
    for (const claims::StoredFinding& finding : findings)
        if (!std::isfinite(finding.value))
            lines += fmt::format("\n{}: no {}: {}", finding.experiment, finding.quantity, finding.note);
    return lines.empty() ? lines : lines + "\n";
}

/// Runs the paper's experiments. They take seconds with --quick, otherwise minutes.
std::vector<claims::StoredFinding> findingsOf(const PaperWork& work) {
    const std::vector<std::string>& experiments = work.paper.experiments;
    const EndsWhenInterrupted untilTheyEnd;
    std::vector<claims::StoredFinding> findings;
    for (std::size_t n = 0; n < experiments.size(); ++n) {
        std::cerr << fmt::format("experiment {} of {}: {}", n + 1, experiments.size(), experiments[n]) << std::endl;
        std::ranges::move(claims::runExperiment(experiments[n], work.quick), std::back_inserter(findings));
    }
    return findings;
}

/// Runs a paper's suites and experiments, prints tables and verdicts, writes its page and adds its line to `index`.
int reproducePaper(const PaperWork& work, std::vector<report::PaperLine>& index) {
    const suite::Paper& paper = work.paper;
    results::ResultsFolder& results = *work.results;
    const std::string year = paper.year != 0 ? fmt::format(" ({})", paper.year) : "";
    std::cout << fmt::format("{}{}: {}\n", paper.authors, year, paper.title);
    int code = exitOk;
    for (const SuiteWork& each : work.suites) {
        const int suiteCode = runPlan(each.plan, each.suite.repetitions, results, each.options);
        if (suiteCode == exitAborted) return suiteCode;
        code = std::max(code, suiteCode);
        std::cout << "\n" << suiteReport(each.suite, results.runs()) << std::flush;
    }
    const std::vector<claims::StoredFinding> findings = findingsOf(work);
    if (!findings.empty()) exports::writeWhole(results.path() / "experiments.csv", claims::findingsCsv(findings));
    std::cout << notMeasured(findings);
    const auto summary = files::CsvTable::parseFile(results.path() / "summary.csv");
    if (const std::string numbers = publishedReport(claims::tabulatePrinted(paper.id, summary)); !numbers.empty())
        std::cout << "\n" << numbers;
    const auto claims = claims::evaluateClaims(paper.id, summary, findings);
    exports::writeWhole(results.path() / "claims.csv", claims::claimsCsv(claims));
    std::cout << "\n" << claimsReport(claims);
    for (const char* file : {"summary.csv", "experiments.csv", "claims.csv"})
        if (std::filesystem::exists(results.path() / file)) std::cout << (results.path() / file).string() << "\n";
    const report::ReportData report = report::readReport(results.path(), report::defaultPictureBytes);
    std::cout << report::writePage(results.path(), report).string() << "  (open it in a browser)\n";
    index.push_back(report::lineOf(report, paper, results.path().filename().string()));
    return code;
}

int reproduce(const ReproduceOptions& options) {
    if (options.quick && options.full) throw InputError("--quick and --full: got both, allowed: one of them");
    std::vector<PaperWork> work = gatherWork(options);
    if (options.dryRun) {
        printWork(work);
        return exitOk;
    }
    requireOpenGl();
    openFolders(options, work);
    if (!options.quick && !sayHowLong(work)) {
        std::cerr << "aborted before the first run" << std::endl;
        return exitAborted;
    }
    int code = exitOk;
    std::vector<report::PaperLine> index;
    for (const PaperWork& paper : work) {
        const int paperCode = reproducePaper(paper, index);
        if (paperCode == exitAborted) return paperCode;
        code = std::max(code, paperCode);
    }
    if (options.paper.empty())
        std::cout << report::writePapersPage(folderOfAll(options), index).string() << "  (all papers)\n";
    return code;
}

}  // namespace

Command reproduceCommand() {
    auto options = std::make_shared<ReproduceOptions>();
    return {
        "reproduce", "Run the experiments of a paper and print the results", "Existing results are kept.",
        [options](Arguments& arguments) {
            arguments.text("--paper", "ID", "a folder of data/papers, such as carr2006; default: all papers",
                           options->paper);
            arguments.flag("--quick", "run reduced suites and experiments: minutes instead of hours", options->quick);
            arguments.flag("--full", "run the complete suites, as without --quick; first estimates how long they take",
                           options->full);
            arguments.flag("--controls",
                           "also run the suites of the claims' controls: data with a known verdict, which detect "
                           "a rule that cannot fail",
                           options->controls);
            arguments.flag("--dry-run",
                           "check all files of the papers and print each suite with its number of runs; measure "
                           "nothing",
                           options->dryRun);
            arguments.text("--out", "DIR", "folder for the results; default: reports/out/<paper>", options->out);
        },
        [options] { return reproduce(*options); }};
}

}  // namespace dustbench::cli
