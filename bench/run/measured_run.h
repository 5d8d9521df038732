// Executes one run from start to end in its own process: world, method, preroll, verification, warm-up, frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/run_record.h"

namespace dustbench::bench {

/// `phase` is `preroll`, `warmup`, `frames` or `metrics`; `metrics` has as many steps as the other three together.
/// Called before each step, and once at the end of `frames` and `metrics`.
using RunProgress = std::function<void(std::string_view phase, std::int64_t done, std::int64_t total)>;

/// Measures the run and writes frames.csv, stages.csv, metrics.csv, images/ and volumes/ to `folder`. `argv` is the
/// user's command; `references` is that of evaluateRun. Throws InputError for user-correctable errors and
/// std::runtime_error if the method fails.
[[nodiscard]] RunRecord measureRun(const RunSpec& spec, const std::filesystem::path& folder,
                                   std::vector<std::string> argv, const RunProgress& progress,
                                   const std::filesystem::path& references = {});

}  // namespace dustbench::bench
