// The process of one run: measures it, writes its files and reports progress to the parent process on stdout; or only
// starts the run and prints a forecast of its duration.
#include <unistd.h>

#include <chrono>
#include <exception>

#include "bench/cli/commands.h"
#include "bench/results/results_folder.h"
#include "bench/run/measured_run.h"
#include "bench/run/run_forecast.h"
#include "bench/run/run_messages.h"
#include "bench/suite/method_libraries.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::cli {
namespace {

results::RunSpec specOf(const std::vector<std::string>& argv) {
    if (argv.size() < 4 || argv[3] != "--")
        throw InputError(argv[0] + ": expected the arguments SPEC FOLDER -- COMMAND");
    return results::specFromJson(files::wholeText(argv[1], "a run's specification"));
}

/// Not buffered: the parent process waits for it.
void send(const std::string& line) {
    [[maybe_unused]] const auto written = write(STDOUT_FILENO, line.data(), line.size());
}

void measure(const std::vector<std::string>& argv) {
    suite::loadMethodLibraries();
    const results::RunSpec spec = specOf(argv);
    const std::filesystem::path folder = argv[2];

    auto lastSaid = std::chrono::steady_clock::now();
    const auto progress = [&lastSaid](std::string_view phase, std::int64_t done, std::int64_t total) {
        const auto now = std::chrono::steady_clock::now();
        if (now - lastSaid < std::chrono::milliseconds(100) && done != total) return;
        lastSaid = now;
        send(run::lineOf(phase, done, total));
    };
    const results::RunRecord record =
        run::measureRun(spec, folder, {argv.begin() + 4, argv.end()}, progress, results::referencesBeside(folder));
    exports::writeWhole(folder / "run.json", results::toJson(record));
}

}  // namespace

int measureRunCommand(const std::vector<std::string>& argv) {
    try {
        measure(argv);
    } catch (const std::exception&) {
        send(run::lineOf(errorOfException()));
        throw;
    }
    return exitOk;
}

int forecastRunCommand(const std::vector<std::string>& argv) {
    suite::loadMethodLibraries();
    send(run::lineOf(run::forecastRun(specOf(argv), argv[2])));
    return exitOk;
}

}  // namespace dustbench::cli
