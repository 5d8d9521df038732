#include "bench/run/remaining_time.h"

namespace dustbench::bench {

RemainingTime::RemainingTime(const std::vector<const PlannedRun*>& toDo) {
    for (const PlannedRun* run : toDo) {
        RunSpec cell = run->spec;
        cell.repetition = 1;
        cells_.push_back(canonicalKey(cell));
    }
}

void RemainingTime::ended(double seconds) {
    for (Ended* each : {&byCell_[cells_[next_]], &all_}) {
        each->sum += seconds;
        ++each->count;
    }
    ++next_;
}

double RemainingTime::seconds() const {
    if (all_.count == 0) return -1;
    double sum = 0;
    for (std::size_t run = next_; run < cells_.size(); ++run) {
        const auto cell = byCell_.find(cells_[run]);
        sum += cell == byCell_.end() ? all_.mean() : cell->second.mean();
    }
    return sum;
}

}  // namespace dustbench::bench
