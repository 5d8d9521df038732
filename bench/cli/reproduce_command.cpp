// `dustbench reproduce`: runs the suites of a paper, prints what came out, and writes its page.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "bench/claims/claim_ledger.h"
#include "bench/claims/published_numbers.h"
#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/suite_report.h"
#include "bench/report/page.h"
#include "bench/report/report_reader.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "methods/shared/errors.h"
#include "methods/shared/files/csv.h"

namespace dustbench::cli {
namespace {

struct ReproduceOptions {
    std::string paper, out;
    bool quick = false, full = false;
};

int reproduce(const ReproduceOptions& options) {
    if (options.quick && options.full) throw InputError("--quick and --full: got both, allowed: one of them");
    std::vector<bench::Paper> papers;
    for (const std::string& id : options.paper.empty() ? bench::listPapers() : std::vector{options.paper})
        papers.push_back(bench::loadPaper(id));

    int code = exitOk;
    for (const bench::Paper& paper : papers) {
        // Several papers of one call lie side by side.
        std::filesystem::path out = options.out;
        if (options.out.empty()) out = std::filesystem::path("reports/out") / paper.id;
        if (!options.out.empty() && options.paper.empty()) out /= paper.id;
        bench::ResultsFolder results(out);
        const std::string year = paper.year != 0 ? fmt::format(" ({})", paper.year) : "";
        std::cout << fmt::format("{}{}: {}\n", paper.authors, year, paper.title);
        for (const std::string& id : paper.suites) {
            const bench::Suite suite = bench::loadSuite(id, options.quick);
            const auto plan = bench::planRuns(suite);
            checkWorlds(plan);
            PlanOptions planOptions;
            planOptions.timeoutSeconds = suite.timeoutSeconds;
            planOptions.cooldownSeconds = suite.cooldownSeconds;
            const int suiteCode = runPlan(plan, suite.repetitions, results, planOptions);
            if (suiteCode == exitAborted) return suiteCode;
            code = std::max(code, suiteCode);
            std::cout << "\n" << suiteReport(suite, results.runs()) << std::flush;
        }
        std::vector<bench::Finding> findings;
        for (const std::string& id : paper.experiments)
            std::ranges::move(bench::runExperiment(id), std::back_inserter(findings));
        if (!findings.empty()) bench::writeWhole(results.path() / "experiments.csv", bench::findingsCsv(findings));
        const auto summary = files::CsvTable::parseFile(results.path() / "summary.csv");
        if (const std::string numbers = publishedReport(bench::tabulatePublished(paper.id, summary)); !numbers.empty())
            std::cout << "\n" << numbers;
        const auto claims = bench::judgeClaims(paper.id, summary, findings);
        bench::writeWhole(results.path() / "claims.csv", bench::claimsCsv(claims));
        std::cout << "\n" << claimsReport(claims);
        for (const char* file : {"summary.csv", "experiments.csv", "claims.csv"})
            if (std::filesystem::exists(results.path() / file)) std::cout << (results.path() / file).string() << "\n";
        const bench::ReportData report = bench::readReport(results.path(), bench::defaultPictureBytes);
        std::cout << bench::writePage(results.path(), report).string() << "  (open it in a browser)\n";
    }
    return code;
}

}  // namespace

Command reproduceCommand() {
    auto options = std::make_shared<ReproduceOptions>();
    return {"reproduce", "Run the experiments of a paper and print what came out",
            "Runs whose results are there already are left alone.",
            [options](Arguments& arguments) {
                arguments.text("--paper", "ID", "carr2006 …: a folder of data/papers; all of them unless given",
                               options->paper);
                arguments.flag("--quick", "the suites' short forms: minutes instead of hours", options->quick);
                arguments.flag("--full", "the whole suites (as without --quick)", options->full);
                arguments.text("--out", "DIR", "folder for the results; reports/out/<paper> unless given",
                               options->out);
            },
            [options] { return reproduce(*options); }};
}

}  // namespace dustbench::cli
