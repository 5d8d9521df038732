// selfcheck.json: the findings of a self-check, written and read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/measure/provenance.h"
#include "bench/selfcheck/check.h"

namespace dustbench::bench {

/// An object with `passed`, `device`, `machine`, `program` and `checks`: `{name, outcome, measured, expected, note}`.
[[nodiscard]] std::string selfcheckJson(const Provenance& provenance, const std::vector<Check>& checks);

/// A sentence for each failed check of `folder`/selfcheck.json; none without this file. An unreadable file gives a
/// sentence too.
[[nodiscard]] std::vector<std::string> selfcheckProblems(const std::filesystem::path& folder);

}  // namespace dustbench::bench
