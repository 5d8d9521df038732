// Commands that method folders provide (methods/contract/experiment.h).
#include <algorithm>
#include <iostream>
#include <memory>

#include "bench/claims/experiments.h"
#include "bench/cli/commands.h"
#include "bench/cli/text_table.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::cli {
namespace {

constexpr std::uint64_t toolSeed = 1;

int runTool(const ToolInfo& tool, const std::vector<ToolArgument>& given) {
    claims::ProgramContext context(toolSeed);
    std::cout << textTable(tool.run(context, given));
    return exitOk;
}

void add(std::vector<ToolArgument>& given, const ToolOption& option, const std::string& value) {
    if (!option.repeats && std::ranges::find(given, option.name, &ToolArgument::name) != given.end())
        throw InputError(option.name + ": got '" + value + "' in addition, allowed: once");
    given.push_back({option.name, value});
}

Command toolCommand(const ToolInfo& tool) {
    auto given = std::make_shared<std::vector<ToolArgument>>();
    return {tool.id, tool.summary, tool.manual,
            [&tool, given](Arguments& arguments) {
                for (const ToolOption& option : tool.options)
                    arguments.inOrder(option.name, option.placeholder, option.help,
                                      [&option, given](const std::string& value) { add(*given, option, value); });
            },
            [&tool, given] { return runTool(tool, *given); }};
}

}  // namespace

std::vector<Command> toolCommands() {
    std::vector<Command> commands;
    for (const ToolInfo& tool : tools()) commands.push_back(toolCommand(tool));
    return commands;
}

}  // namespace dustbench::cli
