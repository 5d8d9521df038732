#include "bench/recommend/budget.h"

#include <fmt/format.h>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

constexpr double maximumMs = 1e6;
constexpr double millisecondsOfSecond = 1000;

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

Budget parseBudget(const std::string& what, const std::string& text) {
    const std::size_t unitAt = text.find_first_not_of("0123456789.+-eE ");
    const std::string unit = unitAt == std::string::npos ? "" : trimmed(text.substr(unitAt));
    const auto number = files::numberOf(trimmed(text.substr(0, unitAt)));
    if (number && *number > 0 && (unit == "ms" || unit == "fps")) {
        const double ms = unit == "ms" ? *number : millisecondsOfSecond / *number;
        if (ms > 0 && ms <= maximumMs) return {ms, text};
    }
    throw InputError(fmt::format("{}: got '{}', allowed: a time (4ms) or a frame rate (60fps); above 0, up to {:g} ms",
                                 what, text, maximumMs));
}

}  // namespace dustbench::bench
