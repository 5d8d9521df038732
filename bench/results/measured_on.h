// Whether two runs were measured on the same machine, drawn by the same graphics device, and built the same way.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Fields of the provenance in run.json in which runs must agree before their times are compared.
[[nodiscard]] std::span<const std::string_view> machineFields();
/// Fields that may well be what is compared, but should be known: `compiler`, `gl_version` …
[[nodiscard]] std::span<const std::string_view> circumstanceFields();

struct FieldDifference {
    std::string field, first, second;
};
[[nodiscard]] std::vector<FieldDifference> differences(const StoredRun& first, const StoredRun& second,
                                                       std::span<const std::string_view> fields);

}  // namespace dustbench::bench
