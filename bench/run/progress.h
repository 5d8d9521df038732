// Formats progress messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "bench/suite/suite.h"

namespace dustbench::run {

/// `3 s`, `4 min 05 s`, `1 h 12 min`; `?` for a negative time.
[[nodiscard]] std::string durationText(double seconds);

/// `[3/48] billboard flat particles=1000 speed=20 rep 2/5 ETA 4 min 05 s`
[[nodiscard]] std::string progressLine(std::size_t position, std::size_t total, const suite::PlannedRun& run,
                                       int repetitions, double etaSeconds);

/// The same as a sentence, for logs: `run 3 of 48: billboard in flat, particles=1000 speed=20, repetition 2 of 5; about
/// 4 min 05 s left`.
[[nodiscard]] std::string progressSentence(std::size_t position, std::size_t total, const suite::PlannedRun& run,
                                           int repetitions, double etaSeconds);

/// For `frames 12 120`, which is 10 %: `[#####…] frames 12/120` on a terminal `width` columns wide. Empty for other
/// lines. `phaseSeconds`: the duration of this phase so far, from which the remaining time is estimated:
/// `frames 12/120, 9 s left`.
[[nodiscard]] std::string progressBar(std::string_view line, int width, double phaseSeconds = 0);
/// `frames: 12 of 120, 9 s left`, for logs. Returns other lines unchanged.
[[nodiscard]] std::string phaseSentence(std::string_view line, double phaseSeconds = 0);
/// `frames` of `frames 12 120`.
[[nodiscard]] std::string_view phaseOf(std::string_view line);

}  // namespace dustbench::run
