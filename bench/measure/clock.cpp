#include "bench/measure/clock.h"

#include <time.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include "bench/measure/stage_recorder.h"
#include "bench/measure/statistics.h"

namespace dustbench::bench {
namespace {

/// Median over several rounds of the nanoseconds per call.
template <typename Call>
double costNs(const Call& call) {
    constexpr int callsPerRound = 1000;
    std::array<double, 21> rounds;
    for (double& round : rounds) {
        const std::int64_t begin = steadyNow();
        for (int i = 0; i < callsPerRound; ++i) call();
        round = static_cast<double>(steadyNow() - begin) / callsPerRound;
    }
    return median(rounds);
}

}  // namespace

std::int64_t steadyNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double secondsSinceProcessStart() {
    std::ifstream file("/proc/self/stat");
    // The second field is the program's name in brackets and may contain spaces; the 22nd is the start in ticks since
    // boot.
    file.ignore(std::numeric_limits<std::streamsize>::max(), ')');
    std::string skipped;
    for (int field = 3; field < 22; ++field) file >> skipped;
    std::int64_t startTicks = 0;
    timespec now{};
    if (!(file >> startTicks) || clock_gettime(CLOCK_BOOTTIME, &now) != 0)
        throw std::runtime_error("/proc/self/stat: does not contain the start time of this process");
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9 -
           static_cast<double>(startTicks) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

ClockCost measureClockCost() {
    StageRecorder recorder;
    const StageClock clock(&recorder);
    return {costNs([] { [[maybe_unused]] const volatile std::int64_t now = steadyNow(); }),
            costNs([&] { const auto timing = clock.measure(Stage::build); })};
}

}  // namespace dustbench::bench
