#include "bench/run/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dustbench::bench {

std::string durationText(double seconds) {
    if (seconds < 0) return "?";
    const auto whole = static_cast<long>(std::lround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string progressLine(std::size_t position, std::size_t total, const PlannedRun& run, int repetitions,
                         double etaSeconds) {
    return fmt::format("[{}/{}] {} {} {}rep {}/{} ETA {}", position, total, run.spec.method, run.spec.scene,
                       run.label.empty() ? "" : run.label + " ", run.spec.repetition, repetitions,
                       durationText(etaSeconds));
}

std::string progressBar(std::string_view line, int width) {
    std::istringstream words{std::string(line)};
    std::string phase;
    long done = 0, total = 0;
    if (!(words >> phase >> done >> total) || total <= 0) return {};
    const std::string text = fmt::format(" {} {}/{}", phase, done, total);
    const int room = std::clamp(width - static_cast<int>(text.size()) - 2, 0, 40);
    const auto filled = static_cast<int>(room * std::clamp<long>(done, 0, total) / total);
    return fmt::format("[{}{}]{}", std::string(static_cast<std::size_t>(filled), '#'),
                       std::string(static_cast<std::size_t>(room - filled), '.'), text);
}

}  // namespace dustbench::bench
