// Generates the scripts with which shells complete the command line, from the declarations of the subcommands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/cli/declared_command.h"

namespace dustbench::cli {

/// `bash zsh fish`
[[nodiscard]] const std::vector<std::string>& completedShells();

/// The script for one of completedShells(). `common`: options of every command, before or after its name. Names of
/// methods, scenes and so on are queried with `dustbench list` during completion.
[[nodiscard]] std::string completionScript(std::string_view shell, const std::vector<DeclaredCommand>& commands,
                                           const std::vector<DeclaredOption>& common);

}  // namespace dustbench::cli
