// Formats progress messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "bench/suite/suite.h"

namespace dustbench::bench {

/// `3 s`, `4 min 05 s`, `1 h 12 min`; `?` for a negative time.
[[nodiscard]] std::string durationText(double seconds);

/// `[3/48] billboard flat particles=1000 speed=20 rep 2/5 ETA 4 min 05 s`
[[nodiscard]] std::string progressLine(std::size_t position, std::size_t total, const PlannedRun& run, int repetitions,
                                       double etaSeconds);

/// For `frames 12 120`, which is 10 %: `[#####…] frames 12/120` on a terminal `width` columns wide. Empty for other
/// lines.
[[nodiscard]] std::string progressBar(std::string_view line, int width);

}  // namespace dustbench::bench
