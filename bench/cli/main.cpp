// The `dustbench` command: parses, runs a subcommand, and turns what it throws into one line and an exit code.
#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/measure/provenance.h"
#include "methods/contract/errors.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::cli {
namespace {

/// A message without line breaks, so that stderr gets one line whatever was thrown.
std::string oneLine(std::string message) {
    std::ranges::replace(message, '\n', ' ');
    return message;
}

/// `--adapter`, for this process and those that it starts.
CommonOptions commonOptions() {
    auto adapter = std::make_shared<std::string>();
    return {[adapter](Arguments& arguments) {
                arguments.text("--adapter", "N|NAME",
                               "what to draw with: index or part of the name of one that `dustbench env` lists; the "
                               "first hardware adapter unless given",
                               *adapter);
            },
            [adapter] {
                if (!adapter->empty()) gpu::askForAdapter(*adapter);
            }};
}

int run(const std::vector<std::string>& argv) {
    if (!argv.empty() && argv.front() == measureRunName) return measureRunCommand(argv);
    if (!argv.empty() && argv.front() == forecastRunName) return forecastRunCommand(argv);
    return dispatch({listCommand(), envCommand(), runCommand(), compareCommand(), suiteCommand(), mergeCommand(),
                     reproduceCommand(), reportCommand(), exportCommand(), diffCommand()},
                    commonOptions(), "dustbench " + bench::buildFacts().version, argv);
}

}  // namespace
}  // namespace dustbench::cli

int main(int argc, char** argv) {
    using namespace dustbench;
    try {
        return cli::run({argv + std::min(argc, 1), argv + argc});
    } catch (const InputError& error) {
        std::cerr << "dustbench: " << cli::oneLine(error.what()) << '\n';
        return cli::exitBadInput;
    } catch (const SimulationError& error) {
        std::cerr << "dustbench: " << cli::oneLine(error.what()) << '\n';
        return cli::exitRunFailed;
    } catch (const std::exception& error) {
        std::cerr << "dustbench: internal error: " << cli::oneLine(error.what()) << '\n';
        return cli::exitInternal;
    }
}
