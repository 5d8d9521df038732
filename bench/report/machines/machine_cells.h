// The cells of several machines: runs that are equal in everything but the repetition, wherever they were measured.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/report/machines/machine_set.h"
#include "bench/suite/regression/folder_cells.h"

namespace dustbench::bench {

struct MachineCell {
    CellIdentity identity;
    std::vector<CellRuns> sides;  ///< by MachineSet::sides
    /// Which of its inputs is not the same everywhere, or `state_hash`: what was measured is not one thing, and its
    /// times are not shown. Empty if it is.
    std::string otherWork{};

    [[nodiscard]] bool isDoneOn(std::size_t side) const { return !sides[side].done.empty(); }
    [[nodiscard]] std::size_t sidesDone() const;
};

struct MachineCells {
    std::vector<MachineCell> cells;  ///< sorted by identity, numbers numerically
    std::vector<std::string> names;  ///< the fields that tell cells of a method apart
    std::vector<std::string>
        unplaced;  ///< a sentence for each machine with copied runs or runs that do not say what they are
    [[nodiscard]] std::string labelOf(const MachineCell& cell) const { return bench::labelOf(cell.identity, names); }
    /// True if a cell is done on two machines and is the same work there.
    [[nodiscard]] bool haveSomethingInCommon() const;
};

/// Points into the set.
[[nodiscard]] MachineCells cellsOf(const MachineSet& set);

}  // namespace dustbench::bench
