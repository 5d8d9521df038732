// The metrics of a run, after its timed frames and apart from them: its states gone through again, some of them drawn
// and held against the exact pictures.
#pragma once

#include <filesystem>
#include <string>

#include "bench/reference/judge/judgement.h"
#include "bench/run/measured_run.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

/// Why a run cannot be judged, or empty: it can. A method with a simulation of its own needs a finer setting of itself
/// to be judged against, which its suite must name.
[[nodiscard]] std::string whyNotJudged(const JudgingPlan& plan, const Method& method);

/// Judges the frames that `spec.judging` names. Leaves metrics.csv in `folder` and, of each moment, the method's
/// picture, the reference (.png, .exr) and FLIP's map (.png) in images/. `stateHash` is that after the run's last
/// frame: throws std::runtime_error where going through it again leads elsewhere.
[[nodiscard]] Judgement judgeRun(const RunSpec& spec, const std::filesystem::path& folder, gpu::Device& device,
                                 const std::string& stateHash, const RunProgress& progress);

}  // namespace dustbench::bench
