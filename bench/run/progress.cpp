#include "bench/run/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace dustbench::run {
namespace {

/// `frames 12 120`.
struct Phase {
    std::string name;
    long done = 0, total = 0;

    /// `, 9 s left` if the phase has run for a second and done at least one step; else empty.
    [[nodiscard]] std::string left(double seconds) const {
        if (done <= 0 || done >= total || seconds < 1) return {};
        return fmt::format(", {} left",
                           durationText(seconds / static_cast<double>(done) * static_cast<double>(total - done)));
    }
};

std::optional<Phase> parsePhase(std::string_view line) {
    std::istringstream words{std::string(line)};
    Phase phase;
    if (!(words >> phase.name >> phase.done >> phase.total) || phase.total <= 0) return {};
    return phase;
}

}  // namespace

std::string durationText(double seconds) {
    if (seconds < 0) return "?";
    const auto whole = static_cast<long>(std::lround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string progressLine(std::size_t position, std::size_t total, const suite::PlannedRun& run, int repetitions,
                         double etaSeconds) {
    return fmt::format("[{}/{}] {} {} {}rep {}/{} ETA {}", position, total, run.spec.method, run.spec.scene,
                       run.label.empty() ? "" : run.label + " ", run.spec.repetition, repetitions,
                       durationText(etaSeconds));
}

std::string progressSentence(std::size_t position, std::size_t total, const suite::PlannedRun& run, int repetitions,
                             double etaSeconds) {
    return fmt::format("run {} of {}: {} in {}{}{}, repetition {} of {}{}", position, total, run.spec.method,
                       run.spec.scene, run.label.empty() ? "" : ", ", run.label, run.spec.repetition, repetitions,
                       etaSeconds < 0.5 ? "" : fmt::format("; about {} left", durationText(etaSeconds)));
}

std::string progressBar(std::string_view line, int width, double phaseSeconds) {
    const auto phase = parsePhase(line);
    if (!phase) return {};
    const std::string text =
        fmt::format(" {} {}/{}{}", phase->name, phase->done, phase->total, phase->left(phaseSeconds));
    const int room = std::clamp(width - static_cast<int>(text.size()) - 2, 0, 40);
    const auto filled = static_cast<int>(room * std::clamp<long>(phase->done, 0, phase->total) / phase->total);
    return fmt::format("[{}{}]{}", std::string(static_cast<std::size_t>(filled), '#'),
                       std::string(static_cast<std::size_t>(room - filled), '.'), text);
}

std::string phaseSentence(std::string_view line, double phaseSeconds) {
    const auto phase = parsePhase(line);
    if (!phase) return std::string(line);
    return fmt::format("{}: {} of {}{}", phase->name, phase->done, phase->total, phase->left(phaseSeconds));
}

std::string_view phaseOf(std::string_view line) {
    return line.substr(0, line.find(' '));
}

}  // namespace dustbench::run
