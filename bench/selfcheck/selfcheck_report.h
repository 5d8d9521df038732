// The findings of a self-check as a JSON document.
#pragma once

#include <string>
#include <vector>

#include "bench/measure/provenance.h"
#include "bench/selfcheck/check.h"

namespace dustbench::bench {

/// An object with `passed`, `device`, `machine`, `program` and `checks`: `{name, outcome, measured, expected, note}`.
[[nodiscard]] std::string selfcheckJson(const Provenance& provenance, const std::vector<Check>& checks);

}  // namespace dustbench::bench
