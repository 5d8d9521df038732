// Scripts by which shells complete the command line, written from what the subcommands declare.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/cli/declared_command.h"

namespace dustbench::cli {

/// `bash zsh fish`
[[nodiscard]] const std::vector<std::string>& completedShells();

/// The script for one of completedShells(). `common`: options of every command, before or after its name. Names of
/// methods, scenes and the like are asked of `dustbench list` while one types.
[[nodiscard]] std::string completionScript(std::string_view shell, const std::vector<DeclaredCommand>& commands,
                                           const std::vector<DeclaredOption>& common);

}  // namespace dustbench::cli
