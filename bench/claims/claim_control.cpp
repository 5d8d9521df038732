#include "bench/claims/claim_control.h"

#include <fmt/format.h>

#include <cmath>

namespace dustbench::bench {

ClaimVerdict verdictOf(ControlOutcome outcome) {
    return outcome == ControlOutcome::refuted ? ClaimVerdict::refuted : ClaimVerdict::confirmed;
}

namespace {

void append(std::string& text, const std::string& more) {
    text += (text.empty() ? "" : "; ") + more;
}

/// `refuted, as expected (1.31: 40 times the particles)`.
std::string outcomeText(const ControlRule& control, const ClaimResult& found) {
    const bool isExpected = found.verdict == verdictOf(control.gives);
    return fmt::format(
        "{}{} ({}: {})", verdictName(found.verdict),
        isExpected ? ", as expected" : fmt::format(", expected: {}", verdictName(verdictOf(control.gives))),
        std::isfinite(found.measured) ? control.rule.textOf(found.measured) : "nothing measured", control.why);
}

/// True if the control shows that another verdict than this one is possible.
bool isOpposite(ClaimVerdict verdict, ControlOutcome outcome) {
    if (verdict == ClaimVerdict::confirmed) return outcome == ControlOutcome::refuted;
    if (verdict == ClaimVerdict::refuted) return outcome == ControlOutcome::confirmed;
    return true;
}

}  // namespace

ClaimResult evaluateWithControls(const Claim& claim, const RuleEvaluator& evaluate) {
    ClaimResult result = evaluate(claim.rule);
    if (result.verdict == ClaimVerdict::notTested) return result;
    bool missing = false, failed = false, turned = false;
    for (const ControlRule& control : claim.controls) {
        const ClaimResult found = evaluate(control.rule);
        result.controls.push_back({found.verdict, found.measured});
        if (found.verdict == ClaimVerdict::notTested) {
            missing = true;
            append(result.controlNote, "not run: " + control.why);
            continue;
        }
        failed = failed || found.verdict != verdictOf(control.gives);
        turned = turned || isOpposite(result.verdict, control.gives);
        append(result.controlNote, outcomeText(control, found));
    }
    if (!failed && !turned && !missing)
        append(result.controlNote,
               fmt::format("no control can give the opposite of '{}'", verdictName(result.verdict)));
    if (failed || (!turned && !missing))
        result.control = ControlState::notTurned;
    else
        result.control = missing ? ControlState::notRun : ControlState::turned;
    if (result.control != ControlState::notTurned) return result;
    append(result.note, fmt::format("measured: {}; the control did not reverse it", verdictName(result.verdict)));
    result.verdict = ClaimVerdict::untestable;
    return result;
}

}  // namespace dustbench::bench
