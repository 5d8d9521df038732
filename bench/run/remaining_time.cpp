#include "bench/run/remaining_time.h"

namespace dustbench::bench {

RemainingTime::RemainingTime(const std::vector<const PlannedRun*>& toDo, const ForecastByCell& forecasts,
                             double cooldownSeconds) {
    for (const PlannedRun* run : toDo) {
        RunSpec cell = run->spec;
        cell.repetition = 1;
        const double forecast = forecasts.seconds(run->spec);
        const double rest = runs_.empty() ? 0 : cooldownSeconds;
        runs_.push_back({canonicalKey(cell), forecast < 0 ? forecast : forecast + rest});
    }
}

void RemainingTime::ended(double seconds) {
    for (Ended* each : {&byCell_[runs_[next_].cell], &all_}) {
        each->sum += seconds;
        ++each->count;
    }
    ++next_;
}

double RemainingTime::seconds() const {
    double sum = 0;
    for (std::size_t run = next_; run < runs_.size(); ++run) {
        const auto& [cell, forecast] = runs_[run];
        if (const auto ended = byCell_.find(cell); ended != byCell_.end())
            sum += ended->second.mean();
        else if (forecast >= 0)
            sum += forecast;
        else if (all_.count > 0)
            sum += all_.mean();
        else
            return -1;
    }
    return sum;
}

}  // namespace dustbench::bench
