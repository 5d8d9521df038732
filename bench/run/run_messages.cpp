#include "bench/run/run_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "methods/kit/files/printable.h"

namespace dustbench::run {
namespace {

constexpr std::string_view forecastStart = "forecast ", errorStart = "error ";

/// In the order of RunError::Kind.
constexpr std::array<std::string_view, 5> kindNames{"input", "run", "machine", "memory", "internal"};

}  // namespace

std::string lineOf(std::string_view phase, std::int64_t done, std::int64_t total) {
    return fmt::format("{} {} {}\n", phase, done, total);
}

std::string lineOf(const RunForecast& forecast) {
    return fmt::format("{}{:.3f} {:.3f}\n", forecastStart, forecast.measuring, forecast.metricPlan);
}

std::string lineOf(const RunError& error) {
    return fmt::format("{}{} {}\n", errorStart, kindNames.at(static_cast<std::size_t>(error.kind)),
                       files::printable(error.message));
}

std::optional<RunForecast> forecastIn(std::string_view line) {
    if (!line.starts_with(forecastStart)) return {};
    std::istringstream words{std::string(line.substr(forecastStart.size()))};
    RunForecast forecast;
    if (!(words >> forecast.measuring >> forecast.metricPlan)) return {};
    return forecast;
}

std::optional<RunError> errorIn(std::string_view line) {
    if (!line.starts_with(errorStart)) return {};
    line.remove_prefix(errorStart.size());
    const std::string_view name = line.substr(0, line.find(' '));
    const auto kind = std::ranges::find(kindNames, name);
    if (kind == kindNames.end()) return {};
    line.remove_prefix(std::min(line.size(), name.size() + 1));
    return RunError{static_cast<RunError::Kind>(kind - kindNames.begin()), std::string(line)};
}

}  // namespace dustbench::run
