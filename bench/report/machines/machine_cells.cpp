#include "bench/report/machines/machine_cells.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/results/compared_runs.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

/// The first input that differs from those of the cell's first run, or `state_hash`; empty if none differs.
std::string otherWorkIn(const MachineCell& cell) {
    const StoredRun* first = nullptr;
    for (const CellRuns& runs : cell.sides)
        for (const StoredRun* run : runs.done) {
            if (!first) first = run;
            if (std::string file = differingInput(*first, *run); !file.empty()) return file;
            if (run->stateHash != first->stateHash) return "state_hash";
        }
    return {};
}

}  // namespace

std::size_t MachineCell::sidesDone() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(sides, [](const CellRuns& runs) { return !runs.done.empty(); }));
}

bool MachineCells::haveSomethingInCommon() const {
    return std::ranges::any_of(cells,
                               [](const MachineCell& cell) { return cell.otherWork.empty() && cell.sidesDone() > 1; });
}

MachineCells cellsOf(const MachineSet& set) {
    std::map<CellIdentity, MachineCell, decltype(&identityLess)> found(&identityLess);
    MachineCells result;
    std::map<std::string, std::vector<const StoredRun*>> placed;  // by run id, of previous sides
    for (std::size_t side = 0; side < set.sides.size(); ++side) {
        std::size_t unplaced = 0, copied = 0;
        for (const StoredRun* run : set.sides[side].runs) {
            CellIdentity identity;
            try {
                identity = identityOf(*run);
            } catch (const InputError&) {
                ++unplaced;
                continue;
            }
            MachineCell& cell = found[identity];
            cell.identity = std::move(identity);
            cell.sides.resize(set.sides.size());
            std::vector<const StoredRun*>& before = placed[run->runId];
            if (std::ranges::any_of(before,
                                    [run](const StoredRun* other) { return areOneMeasurement(*other, *run); })) {
                cell.sides[side].copied.push_back(run);
                ++copied;
                continue;
            }
            before.push_back(run);
            add(cell.sides[side], *run);
        }
        if (copied > 0)
            result.unplaced.push_back(fmt::format("{}: {} of {} runs were copied from another folder and are left out",
                                                  set.sides[side].label, copied, set.sides[side].runs.size()));
        if (unplaced > 0)
            result.unplaced.push_back(fmt::format("{}: {} of {} runs do not record their settings (provenance.key)",
                                                  set.sides[side].label, unplaced, set.sides[side].runs.size()));
    }
    std::vector<CellIdentity> identities;
    for (auto& [identity, cell] : found) {
        cell.otherWork = otherWorkIn(cell);
        identities.push_back(identity);
        result.cells.push_back(std::move(cell));
    }
    result.names = distinguishingNames(identities);
    return result;
}

}  // namespace dustbench::bench
