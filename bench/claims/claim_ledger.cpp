#include "bench/claims/claim_ledger.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/suite/suite.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

std::string rounded(double value) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "";
}

std::string interval(const ClaimResult& result) {
    if (!std::isfinite(result.low)) return "";
    return fmt::format("[{}, {}]", rounded(result.low), rounded(result.high));
}

}  // namespace

std::set<std::string> runIdsOf(const std::string& suiteId, const files::CsvTable& summary) {
    int repetitions = 1;
    for (std::size_t row = 0; row < summary.rows(); ++row)
        repetitions = std::max(repetitions, static_cast<int>(summary.number(row, "repetition")));
    std::set<std::string> ids;
    for (const bool quick : {false, true})
        for (const PlannedRun& cell : loadSuite(suiteId, quick).cells)
            for (int repetition = 1; repetition <= repetitions; ++repetition)
                ids.insert(runId(inRepetition(cell.spec, repetition)));
    return ids;
}

std::vector<JudgedClaim> judgeClaims(const std::string& paper, const files::CsvTable& summary,
                                     const std::vector<StoredFinding>& findings) {
    std::map<std::string, std::set<std::string>> runIds;
    std::vector<JudgedClaim> judged;
    for (Claim& claim : loadClaims(paper)) {
        if (!claim.suite.empty() && !runIds.contains(claim.suite)) runIds[claim.suite] = runIdsOf(claim.suite, summary);
        const ResultRows rows(summary, &runIds[claim.suite]);
        ClaimResult result =
            claim.quantity == Quantity::finding ? judgeFinding(claim, findings) : judgeClaim(claim, rows);
        judged.push_back({paper, std::move(claim), std::move(result)});
    }
    return judged;
}

std::string claimsCsv(const std::vector<JudgedClaim>& claims) {
    std::string text = "id,paper,claim,verdict,measured,expected,interval,runs,note\n";
    for (const auto& [paper, claim, result] : claims) {
        std::string row;
        for (const std::string& cell :
             {claim.id, paper, claim.text, std::string(verdictName(result.verdict)), files::csvNumber(result.measured),
              claim.expected(), interval(result), fmt::format("{}", fmt::join(result.runs, " ")), result.note})
            row.append(row.empty() ? "" : ",").append(files::csvCell(cell));
        text.append(row).append(1, '\n');
    }
    return text;
}

TextRows tabulate(const std::vector<JudgedClaim>& claims) {
    TextRows table{{"claim", "verdict", "measured", "interval", "expected", "what the paper says"}, {}};
    for (const auto& [paper, claim, result] : claims) {
        std::string text = claim.text;
        if (!result.note.empty()) text += " (" + result.note + ")";
        table.rows.push_back({claim.id, std::string(verdictName(result.verdict)), rounded(result.measured),
                              interval(result), claim.expected(), text});
    }
    return table;
}

}  // namespace dustbench::bench
