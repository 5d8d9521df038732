// Judges the claims of a paper against a results folder's summary.csv and experiments.csv, for claims.csv and the
// console.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "bench/claims/claim_verdict.h"
#include "bench/suite/suite_table.h"

namespace dustbench::bench {

struct JudgedClaim {
    std::string paper;
    Claim claim;
    ClaimResult result;
};

/// Run ids of the suite, in its whole and its quick form, for every repetition number in the table.
[[nodiscard]] std::set<std::string> runIdsOf(const std::string& suite, const files::CsvTable& summary);

/// Each claim is judged by the runs of its suite, in its whole and its quick form, or by its experiment's finding.
/// Throws InputError for a claims.toml or a suite that cannot be read.
[[nodiscard]] std::vector<JudgedClaim> judgeClaims(const std::string& paper, const files::CsvTable& summary,
                                                   const std::vector<StoredFinding>& findings = {});

/// `id,paper,claim,verdict,measured,expected,interval,runs`, as reports/SCHEMA.md defines them.
[[nodiscard]] std::string claimsCsv(const std::vector<JudgedClaim>& claims);

/// A row each: id, verdict, measured value with its interval, expected range, the claim and the note.
[[nodiscard]] TextRows tabulate(const std::vector<JudgedClaim>& claims);

}  // namespace dustbench::bench
