#include "methods/contract/errors.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace dustbench {
namespace {

/// Edit distance with insertions, deletions, substitutions and transpositions of neighbours (optimal string alignment),
/// using three table rows.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        current[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            current[j + 1] = std::min({last[j + 1] + 1, current[j] + 1, last[j] + (a[i] == b[j] ? 0 : 1)});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                current[j + 1] = std::min(current[j + 1], beforeLast[j - 1] + 1);
        }
        std::swap(beforeLast, last);
        std::swap(last, current);
    }
    return last.back();
}

}  // namespace

// Out of line, so that each error has one type, which can be caught on either side of a library boundary.
InputError::~InputError() = default;
SimulationError::~SimulationError() = default;

std::string nearestName(std::string_view got, std::span<const std::string> known) {
    std::string nearest;
    std::size_t minimum = std::max<std::size_t>(1, got.size() / 3) + 1;
    for (const std::string& name : known) {
        const bool isPrefix = got.size() >= 3 && name.starts_with(got);
        const std::size_t distance = isPrefix ? 1 : editDistance(got, name);
        if (distance < minimum) {
            minimum = distance;
            nearest = name;
        }
    }
    return nearest;
}

InputError unknownName(std::string_view kind, std::string_view got, std::span<const std::string> known) {
    std::string message = "unknown " + std::string(kind) + " '" + std::string(got) + "'";
    if (const std::string nearest = nearestName(got, known); !nearest.empty())
        message += " (did you mean '" + nearest + "'?)";
    message += "; known:";
    for (std::size_t i = 0; i < known.size(); ++i) message += (i ? ", " : " ") + known[i];
    if (known.empty()) message += " none";
    return InputError(message);
}

}  // namespace dustbench
