// Evaluates the controls of a claim's rule: data for which the verdict is known.
//
// If a rule gives a wrong verdict on a control, it cannot be trusted on the claim either: the claim is `untestable`,
// whatever was measured. Threads: pure.
#pragma once

#include <functional>

#include "bench/claims/claim_verdict.h"

namespace dustbench::bench {

/// Evaluates a rule with the available data.
using RuleEvaluator = std::function<ClaimResult(const Rule&)>;

/// The verdict that a control is known to have.
[[nodiscard]] ClaimVerdict verdictOf(ControlOutcome outcome);

/// Evaluates the claim and its controls.
[[nodiscard]] ClaimResult evaluateWithControls(const Claim& claim, const RuleEvaluator& evaluate);

}  // namespace dustbench::bench
