#include "bench/run/plan_forecast.h"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <optional>

#include "bench/run/child_process.h"
#include "bench/run/progress.h"
#include "bench/run/run_forecast.h"
#include "bench/run/run_messages.h"

namespace dustbench::run {
namespace fs = std::filesystem;
namespace {

std::string nameOf(const suite::PlannedRun& run) {
    return run.spec.method + " " + run.spec.scene + (run.label.empty() ? "" : " " + run.label);
}

}  // namespace

PlanForecast forecastPlan(const std::vector<suite::PlannedRun>& plan, results::ResultsFolder& results,
                          ExecutionOptions& options, ExecutionListener& listener) {
    using Clock = std::chrono::steady_clock;
    const std::vector<const suite::PlannedRun*> toDo = runsToDo(plan, results, options);
    PlanForecast result;
    result.runs = toDo.size();
    // One run per configuration, with metrics if any of its runs has them.
    std::map<std::string, const suite::PlannedRun*> cells;
    for (const suite::PlannedRun* run : toDo) {
        if (!run->skip.empty()) continue;
        const suite::PlannedRun*& chosen = cells[cellOf(run->spec)];
        if (chosen == nullptr || run->spec.metricPlan) chosen = run;
    }
    std::size_t begun = 0;
    for (const auto& [key, run] : cells) {
        listener.progressed(fmt::format("begun {} {}", begun++, cells.size()));
        const std::string id = results::runId(run->spec);
        const fs::path folder = results.beginRun(id);
        exports::writeWhole(folder / "spec.json", results::specToJson(run->spec));
        std::optional<RunForecast> forecast;
        ChildCommand command;
        command.argv = options.forecastCommand(folder / "spec.json", folder);
        command.log = folder / "log.txt";
        command.timeoutSeconds = options.timeoutSeconds;
        command.limits = options.limits;
        command.interrupted = options.interrupted;
        command.onLine = [&](std::string_view line) {
            if (const auto parsed = forecastIn(line)) forecast = parsed;
            listener.progressed("");
        };
        const auto start = Clock::now();
        const ChildOutcome outcome = runChild(command);
        results.discard(id);
        if (outcome.end == ChildOutcome::End::interrupted) {
            result.aborted = true;
            return result;
        }
        if (!outcome.succeeded() || !forecast) {
            // The run will probably fail in the same way.
            result.warnings.push_back(nameOf(*run) + ": " +
                                      (outcome.succeeded() ? "printed no forecast" : outcome.reason()));
            forecast = RunForecast{std::chrono::duration<double>(Clock::now() - start).count(), 0};
        } else if (options.timeoutSeconds > 0 && forecast->seconds() > options.timeoutSeconds) {
            result.warnings.push_back(fmt::format("{}: will take {}, allowed: {}", nameOf(*run),
                                                  durationText(forecast->seconds()),
                                                  durationText(options.timeoutSeconds)));
        }
        options.forecasts.set(run->spec, *forecast);
    }
    if (!toDo.empty()) result.seconds = RemainingTime(toDo, options.forecasts, options.cooldownSeconds).seconds();
    return result;
}

}  // namespace dustbench::run
