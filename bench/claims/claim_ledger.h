// Evaluates the claims of a paper and their controls, and the numbers printed in it, with a results folder's
// summary.csv and experiments.csv, for claims.csv and the console.
//
// The controls of a claim's rule are data for which the verdict is known. If a rule gives a wrong verdict on a control,
// it cannot be trusted on the claim either: the claim is `untestable`, whatever was measured.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "bench/claims/claim_verdict.h"
#include "bench/suite/suite_table.h"
#include "methods/kit/files/csv.h"

namespace dustbench::claims {

/// Evaluates a rule with the available data.
using RuleEvaluator = std::function<ClaimResult(const Rule&)>;

/// The verdict that a control is known to have.
[[nodiscard]] ClaimVerdict verdictOf(ControlOutcome outcome);

/// Evaluates the claim and its controls.
[[nodiscard]] ClaimResult evaluateWithControls(const Claim& claim, const RuleEvaluator& evaluate);

struct EvaluatedClaim {
    std::string paper;
    Claim claim;
    ClaimResult result;
};

/// `confirmed`, or `confirmed on this device` if the claim is about the device. `depends: true for voxel_edge 4 m` if
/// it is tested along a column.
[[nodiscard]] std::string verdictText(const EvaluatedClaim& evaluated);
/// Replaces the verdict of a claim about the device, if its runs are from several machines, by the verdicts on each:
/// `depends` if they differ. The condition names them.
void tellByMachine(EvaluatedClaim& evaluated, const std::vector<ClaimVerdict>& ofMachines);

/// Ids of the suite's full and quick runs, for every repetition number in the table.
[[nodiscard]] std::set<std::string> runIdsOf(const std::string& suite, const files::CsvTable& summary);

/// Evaluates each claim and its controls with the full and quick runs of their suites, or with findings of experiments.
/// Throws InputError for a claims.toml or a suite that cannot be read.
[[nodiscard]] std::vector<EvaluatedClaim> evaluateClaims(const std::string& paper, const files::CsvTable& summary,
                                                         const std::vector<StoredFinding>& findings = {});

/// A row for each claim, with the columns of reports/SCHEMA.md.
[[nodiscard]] std::string claimsCsv(const std::vector<EvaluatedClaim>& claims);

/// A row for each claim: id, verdict, control, measured value with its interval, expected range, the claim and notes.
[[nodiscard]] suite::TextRows tabulate(const std::vector<EvaluatedClaim>& claims);

/// Compares the numbers printed in a paper, `data/papers/<id>/numbers.csv`, with ours. Its columns: `what`, a
/// description; `suite`, whose runs are used (empty: all), and `of`, a selection of them; `columns` of summary.csv,
/// separated by spaces, whose sum is our number; `published`, the printed number; `formula`, the value of the paper's
/// formula, or empty. A row for each of the paper's numbers: what, published, formula, measured (the median over the
/// runs; empty if there are none) and measured/formula. No rows if the paper has no such file. Throws InputError with
/// file and line.
[[nodiscard]] suite::TextRows tabulatePrinted(const std::string& paper, const files::CsvTable& summary);
/// The same for a table that was already read.
[[nodiscard]] suite::TextRows tabulatePrinted(const files::CsvTable& published, const files::CsvTable& summary);

}  // namespace dustbench::claims
