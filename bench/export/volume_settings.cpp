#include "bench/export/volume_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "bench/export/exporter.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::exports {
namespace {

constexpr std::int64_t maximumFrames = 10'000'000;

constexpr double farthestMetres = 1e6;
constexpr double minimumEdgeMetres = 1e-3;

/// Splits 'a,b,c'; the part after a trailing comma is empty.
std::vector<std::string_view> parts(std::string_view text) {
    std::vector<std::string_view> list;
    for (;;) {
        const std::size_t comma = text.find(',');
        list.push_back(text.substr(0, comma));
        if (comma == std::string_view::npos) return list;
        text.remove_prefix(comma + 1);
    }
}

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

std::vector<std::string> parseFormats(std::string_view text) {
    const std::vector<std::string_view> given = parts(text);
    std::vector<std::string> ids, formats;
    for (const Exporter& exporter : exporters()) {
        ids.push_back(exporter.id);
        if (std::ranges::find(given, exporter.id) != given.end()) formats.push_back(exporter.id);
    }
    for (const std::string_view name : given)
        if (std::ranges::find(ids, name) == ids.end())
            throw InputError(
                fmt::format("format: got '{}', allowed: {}, or several separated by ','", name, fmt::join(ids, ", ")));
    return formats;
}

std::string formatsText(const std::vector<std::string>& formats) {
    return fmt::format("{}", fmt::join(formats, ","));
}

Box parseRegion(std::string_view text) {
    const auto refuse = [&](const std::string& why) {
        return InputError(fmt::format("region: got '{}', {}, expected x0,y0,z0,x1,y1,z1 in metres", text, why));
    };
    std::vector<double> numbers;
    for (const std::string_view part : parts(text)) {
        double number = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
        if (error != std::errc() || end != part.data() + part.size())
            throw refuse(fmt::format("but '{}' is not a number", part));
        if (!(std::abs(number) <= farthestMetres)) throw refuse("with a number outside -1000000..1000000");
        numbers.push_back(number);
    }
    if (numbers.size() != 6) throw refuse(fmt::format("which has {} numbers", numbers.size()));
    const Box box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
    for (int axis = 0; axis < 3; ++axis)
        if (!(box.maximum[axis] - box.minimum[axis] >= minimumEdgeMetres))
            throw refuse(fmt::format("but {0}1 must exceed {0}0 by at least 0.001", "xyz"[axis]));
    return box;
}

std::string regionText(const Box& region) {
    std::string text;
    for (const glm::dvec3& corner : {region.minimum, region.maximum})
        for (int axis = 0; axis < 3; ++axis)
            text.append(text.empty() ? "" : ",").append(files::csvNumber(corner[axis]));
    return text;
}

int parseResolution(std::string_view text) {
    int cells = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), cells);
    if (error != std::errc() || end != text.data() + text.size() || cells < 1 || cells > maximumCellsPerEdge)
        throw InputError(fmt::format("resolution: got '{}', allowed: integer 1..{}", text, maximumCellsPerEdge));
    return cells;
}

void VolumeSettings::setOption(const std::string& id, const std::string& word) {
    const ExporterOption& declared = exporterOption(id);
    if (std::ranges::find(declared.words, word) == declared.words.end()) {
        std::string name = id;
        std::ranges::replace(name, '_', ' ');
        throw InputError(fmt::format("{}: got '{}', allowed: {}", name, word, fmt::join(declared.words, "|")));
    }
    options.erase(id);
    if (word != declared.words.front()) options[id] = word;
}

const std::string& VolumeSettings::option(const std::string& id) const {
    const auto found = options.find(id);
    return found == options.end() ? exporterOption(id).words.front() : found->second;
}

std::vector<std::pair<std::string, std::string>> VolumeSettings::namedOptions() const {
    std::vector<std::pair<std::string, std::string>> named;
    for (const ExporterOption& declared : exporterOptions())
        if (declared.isAlwaysNamed || options.contains(declared.id))
            named.emplace_back(declared.id, option(declared.id));
    return named;
}

}  // namespace dustbench::exports
