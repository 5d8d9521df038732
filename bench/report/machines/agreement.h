// Whether machines agree on a ratio of times or on a claim.
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
    agree,   ///< the same verdict on all machines, and all intervals overlap
    factor,  ///< the same verdict, but two intervals do not overlap
    differ,  ///< different verdicts
    open,    ///< not resolved on all machines, but without contradiction
    alone    ///< measured on fewer than two machines
};
/// `agree`, `agree, by different factors` …
[[nodiscard]] std::string_view agreementText(Agreement agreement);

/// Machines without the ratio do not count.
[[nodiscard]] Agreement agreementOf(const std::vector<SideRatio>& sides);

/// Compares verdicts. Claims that are not tested do not count; unresolved and untestable ones are open.
[[nodiscard]] Agreement agreementOf(const std::vector<ClaimVerdict>& verdicts);

/// A claim with its results in the folders that contain it.
struct SharedClaim {
    std::vector<const EvaluatedClaim*> folders;  ///< by MachineSet::folders; null if missing
    Agreement agreement = Agreement::alone;

    /// From any folder: the claim is the same in all.
    [[nodiscard]] const EvaluatedClaim& any() const;
};

/// Sorted by paper, in the order of the paper. Points into the set.
[[nodiscard]] std::vector<SharedClaim> sharedClaims(const MachineSet& set);

}  // namespace dustbench::bench
