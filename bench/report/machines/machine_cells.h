// The configurations measured on several machines. A cell contains all runs of one configuration, whose settings differ
// only in the repetition.
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
    /// An input that is not the same everywhere, or `state_hash`: different work was measured, and its times are not
    /// shown. Empty if the work is the same.
    std::string otherWork{};

    [[nodiscard]] bool isDoneOn(std::size_t side) const { return !sides[side].done.empty(); }
    [[nodiscard]] std::size_t sidesDone() const;
};

struct MachineCells {
    std::vector<MachineCell> cells;     ///< sorted by identity, numbers numerically
    std::vector<std::string> names;     ///< the fields that distinguish cells of a method
    std::vector<std::string> unplaced;  ///< a sentence for each machine with copied runs or with runs without settings
    [[nodiscard]] std::string labelOf(const MachineCell& cell) const { return bench::labelOf(cell.identity, names); }
    /// True if a cell is completed on two machines with the same work.
    [[nodiscard]] bool haveSomethingInCommon() const;
};

/// Points into the set.
[[nodiscard]] MachineCells cellsOf(const MachineSet& set);

}  // namespace dustbench::bench
