// The manual page dustbench(1), written from what the subcommands declare.
#pragma once

#include <string>
#include <vector>

#include "bench/cli/declared_command.h"

namespace dustbench::cli {

/// In man(7)'s language. `common`: options of every command.
[[nodiscard]] std::string manPage(const std::vector<DeclaredCommand>& commands,
                                  const std::vector<DeclaredOption>& common, const std::string& version);

}  // namespace dustbench::cli
