#include "methods/grid_fluid/flow/closed_regions.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

namespace dustbench::grid_fluid::flow {
namespace {

/// Disjoint sets (union-find); each is identified by its minimum member.
class Sets {
 public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
    [[nodiscard]] std::size_t of(std::size_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    void merge(std::size_t a, std::size_t b) {
        a = of(a), b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

 private:
    std::vector<std::size_t> parent_;
};

void findRuns(const std::uint8_t* row, int nx, int j, int k, std::vector<Run>& runs) {
    for (int i = 0; i < nx;) {
        if (row[i] != 1) {
            ++i;
            continue;
        }
        const void* solid = std::memchr(row + i, 0, static_cast<std::size_t>(nx - i));
        const int end = solid == nullptr ? nx : static_cast<int>(static_cast<const std::uint8_t*>(solid) - row);
        runs.push_back({i, end, j, k});
        i = end;
    }
}

}  // namespace

std::vector<std::vector<Run>> closedRegions(const CellLayout& layout, const std::uint8_t* conductance) {
    std::vector<Run> runs;
    std::vector<std::size_t> firstOfRow(layout.rows() + 1);
    for (std::size_t r = 0; r < layout.rows(); ++r) {
        firstOfRow[r] = runs.size();
        const int j = layout.rowJ(r), k = layout.rowK(r);
        findRuns(conductance + layout.at(0, j, k), layout.nx, j, k, runs);
    }
    firstOfRow[layout.rows()] = runs.size();
    Sets sets(runs.size());
    const auto mergeRows = [&](std::size_t one, std::size_t other) {
        std::size_t a = firstOfRow[one], b = firstOfRow[other];
        while (a < firstOfRow[one + 1] && b < firstOfRow[other + 1]) {
            if (std::max(runs[a].i, runs[b].i) < std::min(runs[a].end, runs[b].end)) sets.merge(a, b);
            if (runs[a].end < runs[b].end)
                ++a;
            else
                ++b;
        }
    };
    const auto ny = static_cast<std::size_t>(layout.ny);
    for (std::size_t r = 0; r < layout.rows(); ++r) {
        if (r % ny != 0) mergeRows(r - 1, r);
        if (r >= ny) mergeRows(r - ny, r);
    }
    std::vector<bool> isOpen(runs.size(), false);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const Run& run = runs[r];
        const auto opens = [&](int i, int j, int k, std::size_t count) {
            return std::memchr(conductance + layout.at(i, j, k), 2, count) != nullptr;
        };
        const auto length = static_cast<std::size_t>(run.end - run.i);
        if ((run.i == 0 && opens(-1, run.j, run.k, 1)) || (run.end == layout.nx && opens(layout.nx, run.j, run.k, 1)) ||
            (run.j == 0 && opens(run.i, -1, run.k, length)) ||
            (run.j == layout.ny - 1 && opens(run.i, layout.ny, run.k, length)) ||
            (run.k == 0 && opens(run.i, run.j, -1, length)) ||
            (run.k == layout.nz - 1 && opens(run.i, run.j, layout.nz, length)))
            isOpen[sets.of(r)] = true;
    }
    std::map<std::size_t, std::vector<Run>> closedRuns;
    for (std::size_t r = 0; r < runs.size(); ++r)
        if (const std::size_t set = sets.of(r); !isOpen[set]) closedRuns[set].push_back(runs[r]);
    std::vector<std::vector<Run>> regions;
    regions.reserve(closedRuns.size());
    for (auto& [set, region] : closedRuns) regions.push_back(std::move(region));
    return regions;
}

}  // namespace dustbench::grid_fluid::flow
