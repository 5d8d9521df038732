// One run from beginning to end, in the process that is its own: world, method, preroll, verification, warm-up, frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/run_record.h"

namespace dustbench::bench {

/// `phase` is `preroll`, `warmup`, `frames` or `metrics`, whose steps are those of all three. Heard before each step,
/// and once at the end of `frames` and `metrics`.
using RunProgress = std::function<void(std::string_view phase, std::int64_t done, std::int64_t total)>;

/// Measures and leaves frames.csv, stages.csv, metrics.csv, images/ and volumes/ in `folder`. `argv` is the command the
/// user gave. Throws InputError for what a person can mend and std::runtime_error where the method fails.
[[nodiscard]] RunRecord measureRun(const RunSpec& spec, const std::filesystem::path& folder,
                                   std::vector<std::string> argv, const RunProgress& progress);

}  // namespace dustbench::bench
