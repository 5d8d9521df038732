#include "bench/selfcheck/machine_checks.h"

#include <fmt/format.h>

namespace dustbench::bench {

std::vector<Check> machineChecks(const Provenance& provenance) {
    constexpr double coarseNs = 1000;
    const double readingNs = provenance.clock.readingNs;
    std::vector<Check> checks{{"clock", readingNs < coarseNs ? Outcome::ok : Outcome::attention,
                               fmt::format("{:.0f} ns per reading", readingNs), fmt::format("below {} ns", coarseNs)}};
    for (const std::string& disturbance : disturbances(provenance.machine))
        checks.push_back({"machine", Outcome::attention, disturbance, ""});
    return checks;
}

Check throttlingCheck(const Machine& before, const Machine& after) {
    const auto events = after.throttled - before.throttled;
    return {"throttling", events > 0 ? Outcome::attention : Outcome::ok, fmt::format("{} events", events), "none",
            events > 0 ? "the processor became too hot: times vary" : ""};
}

Check gpuClockCheck(const GpuClockReadings& readings) {
    if (!readings.before || !readings.during || !readings.after)
        return {"GPU clock", Outcome::ok, "not reported", "", "read by NVML on NVIDIA's GPUs"};
    const auto& [before, during, after] = readings;
    Check check{
        "GPU clock", Outcome::ok,
        fmt::format("{} MHz before, {} under load, {} after", before->megahertz, during->megahertz, after->megahertz),
        "no fall under load"};
    if (!during->throttledBy.empty()) {
        check.outcome = Outcome::attention;
        check.note = "limited by: " + during->throttledBy;
    } else if (during->megahertz < before->megahertz) {
        check.outcome = Outcome::attention;
        check.note = "the clock falls under load: times vary";
    }
    return check;
}

}  // namespace dustbench::bench
