#include "bench/suite/cell_groups.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "bench/suite/suite_axes.h"
#include "bench/suite/suite_verdicts.h"

namespace dustbench::bench {
namespace {

/// Disjoint sets of configurations (union-find); each set is identified by its first one.
class CellGroups {
 public:
    explicit CellGroups(std::size_t cells) : parents_(cells) { std::iota(parents_.begin(), parents_.end(), 0); }
    [[nodiscard]] std::size_t firstOf(std::size_t cell) const {
        while (parents_[cell] != cell) cell = parents_[cell];
        return cell;
    }
    void join(std::size_t a, std::size_t b) {
        const auto [first, later] = std::minmax({firstOf(a), firstOf(b)});
        parents_[later] = first;
    }

 private:
    std::vector<std::size_t> parents_;
};

}  // namespace

std::vector<std::size_t> groupCells(const Suite& suite) {
    CellGroups groups(suite.cells.size());
    std::map<std::string, std::size_t> firstOfWorld;
    for (std::size_t i = 0; i < suite.cells.size(); ++i)
        groups.join(i, firstOfWorld.emplace(worldKey(suite.cells[i].spec), i).first->second);
    for (const PlannedComparison& comparison : suite.comparisons)
        for (const CellPair& pair : matchCells(suite, comparison).pairs)
            groups.join(static_cast<std::size_t>(pair.of - suite.cells.data()),
                        static_cast<std::size_t>(pair.with - suite.cells.data()));
    std::vector<std::size_t> firsts;
    for (std::size_t i = 0; i < suite.cells.size(); ++i) firsts.push_back(groups.firstOf(i));
    return firsts;
}

}  // namespace dustbench::bench
