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

void RemainingTime::ended(std::size_t position, double seconds) {
    Run& run = runs_.at(position);
    for (Ended* each : {&byCell_[run.cell], &all_}) {
        each->sum += seconds;
        ++each->count;
    }
    run.ended = true;
}

double RemainingTime::seconds() const {
    double sum = 0;
    for (const auto& [cell, forecast, isOver] : runs_) {
        if (isOver) continue;
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
