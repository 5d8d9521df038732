#include "bench/report/json_parts.h"

#include <fmt/format.h>

#include "bench/claims/claim_ledger.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace {

using nlohmann::json;

json rounded(double value, int digits) {
    const std::optional<double> number = files::numberOf(fmt::format("{:.{}g}", value, digits));
    return number ? json(*number) : json(nullptr);
}

/// A number of a claim, with more digits, because it may be an integer that must be met exactly.
json claimNumber(double value) {
    return rounded(value, 10);
}

json claimCellJson(const claims::ClaimCell& cell) {
    json at = json::object();
    for (const auto& [column, value] : cell.cell) at[claims::nameOf(column)] = value;
    return {
        {"text", claims::textOf(cell.cell)},     {"at", std::move(at)}, {"low", claimNumber(cell.low)},
        {"high", claimNumber(cell.high)},        {"turns", cell.turns}, {"verdict", claims::verdictName(cell.verdict)},
        {"measured", claimNumber(cell.measured)}};
}

/// The parts of the rule, from which the page makes sentences with names and units.
json ruleJson(const claims::Rule& rule) {
    return {{"quantity", claims::quantityWords.wordOf(rule.quantity)},
            {"experiment", rule.experiment},
            {"column", rule.column},
            {"name", rule.name},
            {"unit", rule.unit},
            {"per", rule.per},
            {"parts", rule.parts},
            {"match", rule.match},
            {"of", claims::textOf(rule.of)},
            {"with", claims::textOf(rule.with)},
            {"against", claims::nameOf(rule.against)},
            {"along", claims::nameOf(rule.along)}};
}

json controlsJson(const claims::Claim& claim, const claims::ClaimResult& result) {
    json list = json::array();
    for (std::size_t i = 0; i < result.controls.size(); ++i)
        list.push_back({{"why", claim.controls[i].why},
                        {"rule", ruleJson(claim.controls[i].rule)},
                        {"known", claims::verdictName(claims::verdictOf(claim.controls[i].gives))},
                        {"verdict", claims::verdictName(result.controls[i].verdict)},
                        {"measured", claimNumber(result.controls[i].measured)}});
    return list;
}

}  // namespace

json number(double value) {
    return rounded(value, 6);
}

json claimJson(const claims::EvaluatedClaim& evaluated) {
    const auto& [paper, claim, result] = evaluated;
    const claims::Rule& rule = claim.rule;
    return {{"id", claim.id},
            {"paper", paper},
            {"text", claim.text},
            {"suite", rule.suite},
            {"rule", ruleJson(rule)},
            {"over", rule.over == claims::Chance::seeds  ? "seeds"
                     : rule.over == claims::Chance::none ? ""
                                                         : "repetitions"},
            {"verdict", claims::verdictName(result.verdict)},
            {"verdictText", claims::verdictText(evaluated)},
            {"control", claims::controlName(result.control)},
            {"controls", controlsJson(claim, result)},
            {"measured", claimNumber(result.measured)},
            {"low", claimNumber(result.low)},
            {"high", claimNumber(result.high)},
            {"min", rule.minimum ? claimNumber(*rule.minimum) : json()},
            {"max", rule.maximum ? claimNumber(*rule.maximum) : json()},
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

}  // namespace dustbench::report
