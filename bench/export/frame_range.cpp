#include "bench/export/frame_range.h"

#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

constexpr std::int64_t maximumFrames = 10'000'000;

}  // namespace

std::string FrameRange::text() const {
    return fmt::format("{}:{}:{}", first, last + 1, step);
}

FrameRange parseFrameRange(std::string_view what, std::string_view text) {
    const auto refuse = [&](const char* why) {
        return InputError(
            fmt::format("{}: got '{}', {}, allowed: A:B:STEP (without frame B), A:B or A, whole "
                        "numbers of 0 or more with A below B",
                        what, text, why));
    };
    std::vector<std::int64_t> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (;;) {
        std::int64_t number = 0;
        const auto [stop, error] = std::from_chars(at, end, number);
        if (error != std::errc()) throw refuse("which is not a range of frames");
        if (number < 0) throw refuse("with a negative number");
        if (number > maximumFrames) throw refuse("with a number above 10000000");
        numbers.push_back(number);
        if (stop == end) break;
        if (*stop != ':' || numbers.size() == 3) throw refuse("which is not a range of frames");
        at = stop + 1;
    }
    const std::int64_t first = numbers[0];
    const std::int64_t beyond = numbers.size() > 1 ? numbers[1] : first + 1;
    const std::int64_t step = numbers.size() > 2 ? numbers[2] : 1;
    if (step == 0) throw refuse("with a step of 0");
    if (beyond < first) throw refuse("which is reversed");
    if (beyond == first) throw refuse("which contains no frame");
    const std::int64_t last = first + (beyond - 1 - first) / step * step;
    // For a single frame the step has no meaning: use 1.
    return {first, last, last == first ? 1 : step};
}

}  // namespace dustbench::bench
