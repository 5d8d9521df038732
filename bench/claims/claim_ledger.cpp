#include "bench/claims/claim_ledger.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/claims/claim_control.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/limits.h"

namespace dustbench::bench {
namespace {

std::string rounded(double value) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "";
}

std::string interval(double low, double high) {
    return std::isfinite(low) ? fmt::format("[{}, {}]", rounded(low), rounded(high)) : "";
}

/// `particles=500 speed=40: 0.91 [0.9, 0.92] confirmed`.
std::string cellText(const ClaimCell& cell) {
    const std::string range = interval(cell.low, cell.high);
    return fmt::format("{}: {}{}{} {}", textOf(cell.cell), rounded(cell.measured), range.empty() ? "" : " ", range,
                       verdictName(cell.verdict));
}

std::string cellsText(const std::vector<ClaimCell>& cells) {
    std::vector<std::string> texts;
    texts.reserve(cells.size());
    if (cells.size() > 1)
        for (const ClaimCell& cell : cells) texts.push_back(cellText(cell));
    return fmt::format("{}", fmt::join(texts, "; "));
}

/// Callers loop up to this number, so it must be within its limit.
int repetitionIn(const files::CsvTable& summary, std::size_t row) {
    const double number = summary.number(row, "repetition");
    if (!(number >= 1 && number <= files::limits::repetitions))
        throw InputError(fmt::format("{}column 'repetition': got '{}', allowed: 1..{} (limit of repetitions)",
                                     summary.where(row), summary.cell(row, "repetition").substr(0, 40),
                                     files::limits::repetitions));
    return static_cast<int>(number);
}

}  // namespace

std::string verdictText(const EvaluatedClaim& evaluated) {
    const ClaimVerdict verdict = evaluated.result.verdict;
    const bool isEvaluated = verdict != ClaimVerdict::untestable && verdict != ClaimVerdict::notTested;
    std::string text =
        std::string(verdictName(verdict)) + (evaluated.claim.device && isEvaluated ? " on this device" : "");
    const std::string& along = evaluated.claim.rule.along;
    if (verdict != ClaimVerdict::depends || along.empty()) return text;
    const std::string interval = intervalAlong(evaluated.result.cells, along);
    return interval.empty() ? text : text + ": " + interval;
}

void tellByMachine(EvaluatedClaim& evaluated, const std::vector<ClaimVerdict>& ofMachines) {
    if (!evaluated.claim.device || ofMachines.size() < 2) return;
    std::vector<std::string> texts;
    std::set<ClaimVerdict> verdicts;
    for (std::size_t i = 0; i < ofMachines.size(); ++i) {
        texts.push_back(fmt::format("{} on machine {}", verdictName(ofMachines[i]), i + 1));
        if (ofMachines[i] != ClaimVerdict::notTested) verdicts.insert(ofMachines[i]);
    }
    if (verdicts.empty()) return;
    evaluated.result.condition = fmt::format("{}", fmt::join(texts, ", "));
    evaluated.result.verdict = verdicts.size() == 1 ? *verdicts.begin() : ClaimVerdict::depends;
    evaluated.claim.device = verdicts.size() == 1;
}

std::set<std::string> runIdsOf(const std::string& suiteId, const files::CsvTable& summary) {
    int repetitions = 1;
    for (std::size_t row = 0; row < summary.rows(); ++row)
        repetitions = std::max(repetitions, repetitionIn(summary, row));
    std::set<std::string> ids;
    for (const bool quick : {false, true})
        for (const PlannedRun& cell : loadSuite(suiteId, quick).cells)
            for (int repetition = 1; repetition <= repetitions; ++repetition)
                ids.insert(runId(inRepetition(cell.spec, repetition)));
    return ids;
}

std::vector<EvaluatedClaim> evaluateClaims(const std::string& paper, const files::CsvTable& summary,
                                           const std::vector<StoredFinding>& findings) {
    std::map<std::string, std::set<std::string>> runIds;
    const RuleEvaluator evaluate = [&](const Rule& rule) {
        if (rule.quantity == Quantity::finding) return evaluateFinding(rule, findings);
        if (!runIds.contains(rule.suite)) runIds[rule.suite] = runIdsOf(rule.suite, summary);
        return evaluateRule(rule, ResultRows(summary, &runIds[rule.suite]));
    };
    std::vector<EvaluatedClaim> evaluated;
    for (Claim& claim : loadClaims(paper)) {
        ClaimResult result;
        result.note = claim.missing;
        if (claim.rule.quantity != Quantity::none) result = evaluateWithControls(claim, evaluate);
        evaluated.push_back({paper, std::move(claim), std::move(result)});
    }
    return evaluated;
}

std::string claimsCsv(const std::vector<EvaluatedClaim>& claims) {
    std::string text =
        "id,paper,claim,verdict,control,measured,expected,interval,condition,cells,quantity,reason,controls,runs,"
        "note,verdict_text\n";
    for (const EvaluatedClaim& evaluated : claims) {
        const auto& [paper, claim, result] = evaluated;
        std::string row;
        for (const std::string& cell :
             {claim.id, paper, claim.text, std::string(verdictName(result.verdict)),
              std::string(controlName(result.control)), files::csvNumber(result.measured), claim.rule.expected(),
              interval(result.low, result.high), result.condition, cellsText(result.cells), claim.rule.inWords(),
              claim.reason, result.controlNote, fmt::format("{}", fmt::join(result.runs, " ")), result.note,
              verdictText(evaluated)})
            row.append(row.empty() ? "" : ",").append(files::csvCell(cell));
        text.append(row).append(1, '\n');
    }
    return text;
}

TextRows tabulate(const std::vector<EvaluatedClaim>& claims) {
    TextRows table{{"claim", "verdict", "control", "measured", "interval", "expected", "the paper's claim"}, {}};
    for (const EvaluatedClaim& evaluated : claims) {
        const auto& [paper, claim, result] = evaluated;
        std::string text = claim.text;
        for (const std::string& more : {result.condition, result.note})
            if (!more.empty()) text += " (" + more + ")";
        const Rule& rule = claim.rule;
        const std::string range =
            std::isfinite(result.low) ? fmt::format("[{}, {}]", rule.textOf(result.low), rule.textOf(result.high)) : "";
        table.rows.push_back({claim.id, verdictText(evaluated), std::string(controlName(result.control)),
                              rule.textOf(result.measured), range, rule.expected(), text});
    }
    return table;
}

}  // namespace dustbench::bench
