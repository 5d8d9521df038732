// The process of one run: measures it, writes its files and reports progress to the parent process on stdout; or only
// starts the run and prints a forecast of its duration.
#include <unistd.h>

#include <chrono>
#include <iostream>

#include "bench/cli/commands.h"
#include "bench/results/results_folder.h"
#include "bench/run/measured_run.h"
#include "bench/run/plan_forecast.h"
#include "bench/run/run_forecast.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::cli {
namespace {

bench::RunSpec specOf(const std::vector<std::string>& argv) {
    if (argv.size() < 4 || argv[3] != "--")
        throw InputError(argv[0] + ": expected the arguments SPEC FOLDER -- COMMAND");
    return bench::specFromJson(files::wholeText(argv[1], "a run's specification"));
}

}  // namespace

int measureRunCommand(const std::vector<std::string>& argv) {
    const bench::RunSpec spec = specOf(argv);
    const std::filesystem::path folder = argv[2];

    auto lastSaid = std::chrono::steady_clock::now();
    const auto progress = [&lastSaid](std::string_view phase, std::int64_t done, std::int64_t total) {
        const auto now = std::chrono::steady_clock::now();
        if (now - lastSaid < std::chrono::milliseconds(100) && done != total) return;
        lastSaid = now;
        const std::string line = std::string(phase) + " " + std::to_string(done) + " " + std::to_string(total) + "\n";
        [[maybe_unused]] const auto written = write(STDOUT_FILENO, line.data(), line.size());
    };
    const bench::RunRecord record =
        bench::measureRun(spec, folder, {argv.begin() + 4, argv.end()}, progress, bench::referencesBeside(folder));
    bench::writeWhole(folder / "run.json", bench::toJson(record));
    return exitOk;
}

int forecastRunCommand(const std::vector<std::string>& argv) {
    std::cout << bench::forecastLine(bench::forecastRun(specOf(argv), argv[2])) << std::endl;
    return exitOk;
}

}  // namespace dustbench::cli
