// Executes one run from start to end in its own process: world, method, preroll, verification, warm-up, frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/run_record.h"

namespace dustbench::run {

/// `phase` is `preroll`, `warmup`, `frames` or `metrics`; `metrics` has as many steps as the other three together.
/// Called before each step, and once at the end of `frames` and `metrics`.
using RunProgress = std::function<void(std::string_view phase, std::int64_t done, std::int64_t total)>;

/// Measures the run and writes frames.csv, stages.csv, metrics.csv, images/ and volumes/ to `folder`. `argv` is the
/// user's command; `references` is that of evaluateRun. Throws InputError for user-correctable errors and
/// std::runtime_error if the method fails.
[[nodiscard]] results::RunRecord measureRun(const results::RunSpec& spec, const std::filesystem::path& folder,
                                            std::vector<std::string> argv, const RunProgress& progress,
                                            const std::filesystem::path& references = {});

/// Calls `work` with at most `threads` threads, oneTBB's and a software rasteriser's; 0: one per core. The limit
/// affects the rasteriser only if OpenGL is not in use yet; it overrides the environment variable `LP_NUM_THREADS`.
void withThreads(int threads, const std::function<void()>& work);

}  // namespace dustbench::run
