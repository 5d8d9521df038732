// Evaluates the claims of a paper with a results folder's summary.csv and experiments.csv, for claims.csv and the
// console.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "bench/claims/claim_verdict.h"
#include "bench/suite/suite_table.h"

namespace dustbench::bench {

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
[[nodiscard]] TextRows tabulate(const std::vector<EvaluatedClaim>& claims);

}  // namespace dustbench::bench
