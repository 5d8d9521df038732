// Parsing and checks that several subcommands share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/suite/suite.h"

namespace dustbench::cli {

/// `name=value` of every -P option, in order; values may be lists and ranges. Throws InputError.
[[nodiscard]] bench::ParameterLists parseParameters(const std::vector<std::string>& texts);

/// Loads every scene and drive of the plan once and looks up the files that parameters refer to, so that their errors
/// are reported before the first run. Throws InputError.
void checkWorlds(const std::vector<bench::PlannedRun>& plan);

}  // namespace dustbench::cli
