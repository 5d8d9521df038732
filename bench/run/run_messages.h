// What the process of a run tells the harness: lines on its standard output.
//
//     frames 12 120                    progress: phase, steps done, steps in total
//     forecast 3.200 0.500             the result of a forecast
//     error memory out of memory       why the process ends: kind and message
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/run/run_forecast.h"

namespace dustbench::run {

struct RunError {
    enum class Kind {
        input,    ///< the user can correct it
        run,      ///< of the method or its simulation
        machine,  ///< a full disk, a quota, too many open files
        memory,   ///< no memory
        internal
    };
    Kind kind = Kind::internal;
    std::string message;
};

/// Each line ends with a line break. Control characters of the message are escaped.
[[nodiscard]] std::string lineOf(std::string_view phase, std::int64_t done, std::int64_t total);
[[nodiscard]] std::string lineOf(const RunForecast& forecast);
[[nodiscard]] std::string lineOf(const RunError& error);

/// Nothing for lines of another kind.
[[nodiscard]] std::optional<RunForecast> forecastIn(std::string_view line);
[[nodiscard]] std::optional<RunError> errorIn(std::string_view line);

}  // namespace dustbench::run
