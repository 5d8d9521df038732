// Runs the controls of a claim's rule: data for which the verdict is known.
//
// A rule that gives another verdict on its control than is known cannot be trusted on the claim either: the claim is
// `untestable`, whatever was measured. Threads: pure.
#pragma once

#include <functional>

#include "bench/claims/claim_verdict.h"

namespace dustbench::bench {

/// Judges any rule by the data at hand.
using RuleJudge = std::function<ClaimResult(const Rule&)>;

/// The verdict that a control must give.
[[nodiscard]] ClaimVerdict verdictOf(ControlOutcome outcome);

/// Judges the claim and its controls.
[[nodiscard]] ClaimResult judgeWithControls(const Claim& claim, const RuleJudge& judge);

}  // namespace dustbench::bench
