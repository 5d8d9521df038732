// `dustbench completion` and `dustbench manual`: print shell completions and the manual page, which packages install.
#include <algorithm>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/completion.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/man_page.h"
#include "bench/measure/provenance.h"
#include "methods/contract/errors.h"

namespace dustbench::cli {
namespace {

Command completionCommand(std::function<int(const std::string&)> complete) {
    auto shell = std::make_shared<std::string>();
    return {"completion", "Print the script with which a shell completes dustbench's command line",
            "To use it in this bash session: `source <(dustbench completion bash)`.",
            [shell](Arguments& arguments) { arguments.required("shell", "bash|zsh|fish", "the shell", *shell); },
            [shell, complete = std::move(complete)] { return complete(*shell); }};
}

Command manualCommand(std::function<int()> print) {
    return {"manual", "Print the manual page", "To read it: `dustbench manual | man -l -`.", [](Arguments&) {},
            std::move(print)};
}

}  // namespace

std::vector<Command> manualCommands(const std::vector<Command>& commands, const CommonOptions& common) {
    auto all = std::make_shared<std::vector<DeclaredCommand>>(declaredCommands(commands));
    auto options = declaredOptions(common);
    std::vector<Command> added{completionCommand([all, options](const std::string& shell) {
                                   if (std::ranges::find(completedShells(), shell) == completedShells().end())
                                       throw unknownName("shell", shell, completedShells());
                                   std::cout << completionScript(shell, *all, options);
                                   return int{exitOk};
                               }),
                               manualCommand([all, options] {
                                   std::cout << manPage(*all, options, bench::buildFacts().version);
                                   return int{exitOk};
                               })};
    std::ranges::move(declaredCommands(added), std::back_inserter(*all));
    return added;
}

}  // namespace dustbench::cli
