// The comparison of several machines: the data of its page and of its text version, and the page itself.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bench/claims/claim_ledger.h"
#include "bench/report/machines/machine_ratios.h"
#include "bench/report/machines/machine_remarks.h"
#include "bench/report/machines/machine_set.h"

namespace dustbench::report {

/// Whether machines agree on a ratio of times or on a claim.
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
[[nodiscard]] Agreement agreementOf(const std::vector<claims::ClaimVerdict>& verdicts);

/// A claim with its results in the folders that contain it.
struct SharedClaim {
    std::vector<const claims::EvaluatedClaim*> folders;  ///< by MachineSet::folders; null if missing
    Agreement agreement = Agreement::alone;

    /// From any folder: the claim is the same in all.
    [[nodiscard]] const claims::EvaluatedClaim& any() const;
};

/// Sorted by paper, in the order of the paper. Points into the set.
[[nodiscard]] std::vector<SharedClaim> sharedClaims(const MachineSet& set);

/// Move, do not copy: contains pointers into its set.
struct MachineComparison {
    MachineSet set;
    MachineCells cells;
    MachineRemarks remarks;
    std::vector<HardwareRow> hardware;
    std::vector<MachineExperiment> experiments;
    std::vector<SharedClaim> claims;

    /// False if no configuration is completed on two machines; the remarks then give the reasons.
    [[nodiscard]] bool isComparable() const { return cells.haveSomethingInCommon(); }
};

[[nodiscard]] MachineComparison comparisonOf(MachineSet set);

/// As JSON, safe inside a script element. The fields are documented at the top of reports/page/machines/page.js.
[[nodiscard]] std::string machinesJson(const MachineComparison& comparison);

/// The whole page, self-contained.
[[nodiscard]] std::string machinesPage(const MachineComparison& comparison);

/// Writes the page to `out`, a file that ends in `.html`, or to index.html in a folder, which is created if missing.
/// Returns its path. Throws InputError if it would replace a page that was not written by this program, or the report
/// of one of the folders.
std::filesystem::path writeMachinesPage(const std::filesystem::path& out, const MachineComparison& comparison);

}  // namespace dustbench::report
