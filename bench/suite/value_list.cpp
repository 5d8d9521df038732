#include "bench/suite/value_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/limits.h"

namespace dustbench::suite {
namespace {

constexpr double maximumValues = 10'000;

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// Rounds to twelve digits, so that 0.1 + 2·0.1 is written as 0.3.
std::string roundedText(double value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 12);
    return files::csvNumber(*number({buffer, end}));
}

std::vector<std::string> range(std::string_view what, std::string_view text) {
    const auto refuse = [&](const std::string& why) {
        return InputError(std::string(what) + ": range '" + std::string(text) + "' " + why +
                          ", expected a:b:step as in 5:40:5");
    };
    const auto parts = split(text, ':');
    std::vector<double> numbers;
    for (const std::string_view part : parts)
        if (const auto value = number(part)) numbers.push_back(*value);
    if (parts.size() != 3 || numbers.size() != 3) throw refuse("does not consist of three numbers");
    const double from = numbers[0], to = numbers[1], step = numbers[2];
    const double steps = (to - from) / step;
    if (step == 0 || steps < 0) throw refuse("never reaches its end");
    if (steps >= maximumValues) throw refuse("has more than 10000 values");

    std::vector<std::string> values;
    const auto last = static_cast<int>(std::floor(steps + 1e-9));
    for (int i = 0; i <= last; ++i) values.push_back(roundedText(from + i * step));
    return values;
}

}  // namespace

std::vector<std::string> expandValues(std::string_view what, std::string_view text) {
    std::vector<std::string> values;
    const std::vector<std::string_view> parts = split(text, ',');
    std::error_code error;
    if (parts.size() > 1 &&
        !std::ranges::all_of(parts, [](std::string_view part) { return number(part).has_value(); }) &&
        std::filesystem::is_regular_file(text, error))
        return {std::string(text)};  // a file whose name contains a comma
    for (const std::string_view part : parts) {
        if (part.empty())
            throw InputError(std::string(what) + ": got '" + std::string(text) + "', expected " +
                             (text.empty() ? "a value" : "a value on each side of ','"));
        const std::string_view first = part.substr(0, part.find(':'));
        if (first.size() < part.size() && number(first)) {
            for (std::string& value : range(what, part)) values.push_back(std::move(value));
        } else {
            values.emplace_back(part);
        }
        if (values.size() > static_cast<std::size_t>(files::limits::plannedRuns))
            throw InputError(std::string(what) + ": got more than " + std::to_string(files::limits::plannedRuns) +
                             " values, the limit of planned runs of a command");
    }
    return values;
}

}  // namespace dustbench::suite
