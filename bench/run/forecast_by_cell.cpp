#include "bench/run/forecast_by_cell.h"

namespace dustbench::bench {

std::string cellOf(RunSpec run) {
    run.repetition = 1;
    run.seed = 1;
    run.metricPlan.reset();
    return canonicalKey(run);
}

void ForecastByCell::set(const RunSpec& cell, const RunForecast& forecast) {
    byCell_[cellOf(cell)] = forecast;
}

double ForecastByCell::seconds(const RunSpec& run) const {
    const auto found = byCell_.find(cellOf(run));
    if (found == byCell_.end()) return -1;
    return run.metricPlan ? found->second.seconds() : found->second.measuring;
}

}  // namespace dustbench::bench
