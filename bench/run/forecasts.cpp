#include "bench/run/forecasts.h"

namespace dustbench::bench {
namespace {

/// What all repetitions of a cell have in common; the first alone is judged.
std::string cellOf(RunSpec run) {
    run.repetition = 1;
    run.judging.reset();
    return canonicalKey(run);
}

}  // namespace

void Forecasts::set(const RunSpec& cell, const RunForecast& forecast) {
    byCell_[cellOf(cell)] = forecast;
}

bool Forecasts::knows(const RunSpec& run) const {
    return byCell_.contains(cellOf(run));
}

double Forecasts::seconds(const RunSpec& run) const {
    const auto found = byCell_.find(cellOf(run));
    if (found == byCell_.end()) return -1;
    return run.judging ? found->second.seconds() : found->second.measuring;
}

}  // namespace dustbench::bench
