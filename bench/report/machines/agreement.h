// Whether machines agree: on a ratio of times, and on a claim.
//
// Threads: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/claims/claim_ledger.h"
#include "bench/report/machines/machine_ratios.h"

namespace dustbench::bench {

enum class Agreement {
    agree,   ///< one verdict on all machines, by intervals that overlap
    factor,  ///< one verdict, but two intervals do not overlap: by another factor
    differ,  ///< two verdicts
    open,    ///< resolved on some or no machines only, and without contradiction
    alone    ///< measured on fewer than two machines
};
/// `agree`, `agree, by another factor` …
[[nodiscard]] std::string_view agreementText(Agreement agreement);

/// Machines without the ratio do not count.
[[nodiscard]] Agreement agreementOf(const std::vector<SideRatio>& sides);

/// By verdicts; those that are not tested do not count, unresolved and untestable ones are open.
[[nodiscard]] Agreement agreementOf(const std::vector<ClaimVerdict>& verdicts);

/// A claim with its results in the folders that hold it.
struct SharedClaim {
    std::vector<const JudgedClaim*> folders;  ///< by MachineSet::folders; null: not there
    Agreement agreement = Agreement::alone;

    /// From any folder: what was claimed is the same in all.
    [[nodiscard]] const JudgedClaim& any() const;
};

/// Sorted by paper, in the order of the paper. Points into the set.
[[nodiscard]] std::vector<SharedClaim> sharedClaims(const MachineSet& set);

}  // namespace dustbench::bench
