// The `dustbench` command: parses the arguments, runs a subcommand, and turns exceptions into one line and an exit
// code.
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>
#include <iterator>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/cli/commands.h"
#include "bench/measure/provenance.h"
#include "bench/suite/method_libraries.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::cli {
namespace {

/// Prints one line to stderr, even if the message quotes line breaks or control characters from a file.
void say(const run::RunError& error) {
    using Kind = run::RunError::Kind;
    const bool isOfMachine = error.kind == Kind::machine || error.kind == Kind::memory;
    const std::string_view kind = isOfMachine ? "aborted: " : error.kind == Kind::internal ? "internal error: " : "";
    std::cerr << "dustbench: " << kind << files::printable(error.message) << std::endl;
}

/// `--adapter`, `--data` and `--method-path`, for this process and its children.
CommonOptions commonOptions() {
    auto adapter = std::make_shared<std::string>();
    // Accepted before and after the subcommand, in the order given.
    auto data = std::make_shared<std::list<std::vector<std::string>>>();
    auto methodPath = std::make_shared<std::list<std::vector<std::string>>>();
    const auto all = [](const std::list<std::vector<std::string>>& given) {
        std::vector<std::string> folders;
        for (const auto& some : given) folders.insert(folders.end(), some.begin(), some.end());
        return folders;
    };
    return {[adapter, data, methodPath](Arguments& arguments) {
                arguments.texts("--data", "DIR",
                                "data folder to search before the installed data; may be given several times, the "
                                "first that contains a name wins; replaces DUSTBENCH_DATA (folders separated by ':')",
                                data->emplace_back());
                arguments.text("--adapter", "N|NAME",
                               "adapter to draw with: index or part of a name listed by `dustbench env`; default: the "
                               "first hardware adapter",
                               *adapter);
                arguments.texts(
                    "--method-path", "DIR",
                    "folder of methods built elsewhere, *.dustmethod.so; may be given several times, the first "
                    "that contains a name wins; replaces DUSTBENCH_METHOD_PATH (folders separated by ':')",
                    methodPath->emplace_back());
            },
            [adapter, data, methodPath, all] {
                if (!adapter->empty()) gpu::askForAdapter(*adapter);
                if (const auto folders = all(*data); !folders.empty()) files::useDataFolders("--data", folders);
                (void)files::namedDataFolders();  // a missing folder is an error for every command
                if (const auto folders = all(*methodPath); !folders.empty())
                    suite::useMethodFolders("--method-path", folders);
                suite::loadMethodLibraries();
            }};
}

/// Throws if standard output could not be written: a full disk would otherwise lose the result silently.
void requireWritten() {
    errno = 0;
    if (std::cout.flush()) return;
    const int error = errno;  // 0 if an earlier write failed
    throw files::MachineError(std::string("standard output cannot be written") +
                              (error != 0 ? std::string(": ") + std::strerror(error) : ""));
}

int run(const std::vector<std::string>& argv) {
    if (!argv.empty() && argv.front() == measureRunName) return measureRunCommand(argv);
    if (!argv.empty() && argv.front() == forecastRunName) return forecastRunCommand(argv);
    std::vector<Command> commands{listCommand(),          envCommand(),    runCommand(),    compareCommand(),
                                  recommendCommand(),     suiteCommand(),  mergeCommand(),  reproduceCommand(),
                                  reportCommand(),        exportCommand(), diffCommand(),   viewCommand(),
                                  newMethodCommand(),     bundleCommand(), verifyCommand(), selfcheckCommand(),
                                  measureMachineCommand()};
    std::ranges::move(toolCommands(), std::back_inserter(commands));
    const CommonOptions common = commonOptions();
    std::ranges::move(manualCommands(commands, common), std::back_inserter(commands));
    return dispatch(commands, common, "dustbench " + measure::buildFacts().version, argv);
}

}  // namespace
}  // namespace dustbench::cli

int main(int argc, char** argv) {
    using namespace dustbench;
    signal(SIGXFSZ, SIG_IGN);  // a write beyond the file size limit fails instead of killing this process or a child
    try {
        const int code = cli::run({argv + std::min(argc, 1), argv + argc});
        cli::requireWritten();
        return code;
    } catch (const std::exception&) {
        const run::RunError error = cli::errorOfException();
        cli::say(error);
        return cli::exitCodeOf(error.kind);
    }
}
