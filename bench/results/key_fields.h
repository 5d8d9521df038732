// Reads the key of a stored run: the settings that distinguish it from others.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Names and values in the order of canonicalKey (run_spec.h): `method`, `scene`, `drive`, `p.particles`, `frames` …
using KeyFields = std::vector<std::pair<std::string, std::string>>;

/// Throws InputError with the run if its provenance has no key, or if a line of the key is not `name=value`.
[[nodiscard]] KeyFields keyFields(const StoredRun& run);

/// The specification of the run, without volumes and metrics. Throws InputError as keyFields does, and for an invalid
/// value.
[[nodiscard]] RunSpec specFromKey(const StoredRun& run);

}  // namespace dustbench::bench
