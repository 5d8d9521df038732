// Generates the manual page dustbench(1) from the declarations of the subcommands.
#pragma once

#include <string>
#include <vector>

#include "bench/cli/declared_command.h"

namespace dustbench::cli {

/// In the format of man(7). `common`: options of every command.
[[nodiscard]] std::string manPage(const std::vector<DeclaredCommand>& commands,
                                  const std::vector<DeclaredOption>& common, const std::string& version);

}  // namespace dustbench::cli
