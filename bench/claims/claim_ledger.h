// The claims of a paper held against a results folder's summary.csv and experiments.csv, as claims.csv and for people.
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

/// The runs that the suite can have in the table, in its whole and its quick form, however often repeated.
[[nodiscard]] std::set<std::string> runIdsOf(const std::string& suite, const files::CsvTable& summary);

/// Of each claim the runs of its suite count, in its whole and its quick form, or what its experiment found. Throws
/// InputError for a claims.toml or a suite that cannot be read.
[[nodiscard]] std::vector<JudgedClaim> judgeClaims(const std::string& paper, const files::CsvTable& summary,
                                                   const std::vector<StoredFinding>& findings = {});

/// `id,paper,claim,verdict,measured,expected,interval,runs`, as reports/SCHEMA.md defines them.
[[nodiscard]] std::string claimsCsv(const std::vector<JudgedClaim>& claims);

/// A row each: id, verdict, what was measured with its interval, what is expected, the claim and the note.
[[nodiscard]] TextRows tabulate(const std::vector<JudgedClaim>& claims);

}  // namespace dustbench::bench
