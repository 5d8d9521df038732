#include "bench/report/json_parts.h"

#include <fmt/format.h>

#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

using nlohmann::json;

json claimCellJson(const ClaimCell& cell) {
    return {{"text", textOf(cell.cell)}, {"measured", number(cell.measured)},
            {"low", number(cell.low)},   {"high", number(cell.high)},
            {"turns", cell.turns},       {"verdict", verdictName(cell.verdict)}};
}

/// The rule in parts, from which the page makes sentences with names and units.
json ruleJson(const Rule& rule) {
    return {{"quantity", quantityWords.wordOf(rule.quantity)},
            {"experiment", rule.experiment},
            {"column", rule.column},
            {"per", rule.per},
            {"parts", rule.parts},
            {"match", rule.match},
            {"of", textOf(rule.of)},
            {"with", textOf(rule.with)},
            {"against", nameOf(rule.against)}};
}

}  // namespace

json number(double value) {
    const std::optional<double> rounded = files::numberOf(fmt::format("{:.6g}", value));
    return rounded ? json(*rounded) : json(nullptr);
}

json claimJson(const JudgedClaim& judged) {
    const auto& [paper, claim, result] = judged;
    const Rule& rule = claim.rule;
    return {{"id", claim.id},
            {"paper", paper},
            {"text", claim.text},
            {"suite", rule.suite},
            {"rule", ruleJson(rule)},
            {"over", rule.over == Chance::seeds  ? "seeds"
                     : rule.over == Chance::none ? ""
                                                 : "repetitions"},
            {"verdict", verdictName(result.verdict)},
            {"control", controlName(result.control)},
            {"controls", result.controlNote},
            {"measured", number(result.measured)},
            {"low", number(result.low)},
            {"high", number(result.high)},
            {"min", rule.minimum ? number(*rule.minimum) : json()},
            {"max", rule.maximum ? number(*rule.maximum) : json()},
            {"expected", rule.expected()},
            {"reason", claim.reason},
            {"condition", result.condition},
            {"cells", each(result.cells, claimCellJson)},
            {"note", result.note}};
}

std::string scriptSafe(const json& root) {
    const std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char letter : text) {
        if (letter == '<')
            safe += "\\u003c";  // occurs only within JSON strings
        else
            safe += letter;
    }
    return safe;
}

}  // namespace dustbench::bench
