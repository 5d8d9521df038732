// Computes the metrics of a run after its timed frames: replays the run and compares some of its frames with reference
// images.
#pragma once

#include <filesystem>
#include <string>

#include "bench/reference/judge/judgement.h"
#include "bench/run/measured_run.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::run {

/// Why a run can have no metrics; empty if it can. The reference of a method with its own simulation is a finer setting
/// of itself, which the suite must name.
[[nodiscard]] std::string whyNotEvaluated(const reference::MetricPlan& plan, const Method& method);

/// Computes the metrics of the frames selected by `spec.metricPlan`. Writes metrics.csv to `folder` and, for each
/// moment, the method's picture and the reference image (.png, .exr) and the FLIP map (.png) to images/. `stateHash` is
/// the state after the run's last frame; throws std::runtime_error if the replay ends in another state. `references`:
/// the folder of reference images that the runs of a suite share; empty: none.
[[nodiscard]] reference::RunMetrics evaluateRun(const results::RunSpec& spec, const std::filesystem::path& folder,
                                                gpu::Device& device, const std::string& stateHash,
                                                const RunProgress& progress,
                                                const std::filesystem::path& references = {});

}  // namespace dustbench::run
