#include "bench/claims/claim_ledger.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "bench/claims/claim_samples.h"
#include "bench/measure/statistics.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/limits.h"

namespace dustbench::claims {

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

/// The sum of the columns of a run; empty if one of them is empty.
std::optional<double> sumOf(const ResultRows& rows, std::size_t row, const std::string& columns) {
    double sum = 0;
    std::istringstream names(columns);
    for (std::string name; names >> name;) {
        const auto value = rows.number(row, name);
        if (!value) return std::nullopt;
        sum += *value;
    }
    return sum;
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
    const auto add = [&](const suite::Suite& suite) {
        for (const suite::PlannedRun& cell : suite.cells)
            for (int repetition = 1; repetition <= repetitions; ++repetition)
                ids.insert(results::runId(suite::inRepetition(cell.spec, repetition)));
    };
    const suite::SuiteForms forms = suite::loadForms(suiteId);
    add(forms.full);
    if (forms.quick) add(*forms.quick);
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

suite::TextRows tabulate(const std::vector<EvaluatedClaim>& claims) {
    suite::TextRows table{{"claim", "verdict", "control", "measured", "interval", "expected", "the paper's claim"}, {}};
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

suite::TextRows tabulatePrinted(const files::CsvTable& published, const files::CsvTable& summary) {
    suite::TextRows table{{"what", "paper", "formula", "measured", "measured/formula"}, {}};
    for (std::size_t line = 0; line < published.rows(); ++line) {
        const std::string where = published.where(line);
        const std::string& columns = published.cell(line, "columns");
        const Selection of = parseSelection(published.cell(line, "of"), where + "of");
        std::istringstream names(columns);
        for (std::string name; names >> name;) requireColumn(where, name);
        const std::string& suite = published.cell(line, "suite");
        std::set<std::string> runs;
        if (!suite.empty()) runs = runIdsOf(suite, summary);
        const ResultRows rows(summary, suite.empty() ? nullptr : &runs);
        std::vector<double> sums;
        for (const std::size_t row : rows.select(of))
            if (const auto sum = sumOf(rows, row, columns)) sums.push_back(*sum);
        const std::string& formula = published.cell(line, "formula");
        std::string measured, ratio;
        if (!sums.empty()) {
            const double found = measure::median(sums);
            measured = found == std::floor(found) ? files::csvNumber(found) : fmt::format("{:.4g}", found);
            if (!formula.empty()) ratio = fmt::format("{:.3f}", found / published.number(line, "formula"));
        }
        table.rows.push_back(
            {published.cell(line, "what"), published.cell(line, "published"), formula, measured, ratio});
    }
    return table;
}

suite::TextRows tabulatePrinted(const std::string& paper, const files::CsvTable& summary) {
    const std::filesystem::path file = suite::paperFile(paper, "numbers.csv");
    if (file.empty()) return {};
    return tabulatePrinted(files::CsvTable::parseFile(file), summary);
}

}  // namespace dustbench::claims
