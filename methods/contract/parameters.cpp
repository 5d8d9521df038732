#include "methods/contract/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "methods/contract/errors.h"

namespace dustbench {
namespace {

/// The shortest text that parses to the same number.
std::string numberText(double value) {
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end};
}

template <typename Number>
std::optional<Number> parseNumber(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// `128x64x64`, each within the range.
std::optional<std::array<int, 3>> parseCells(const Parameter& parameter, std::string_view text) {
    std::array<int, 3> cells{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t end = axis < 2 ? text.find('x') : text.size();
        if (end == std::string_view::npos) return std::nullopt;
        const auto value = parseNumber<int>(text.substr(0, end));
        if (!value || *value < parameter.minimum || *value > parameter.maximum) return std::nullopt;
        cells[axis] = *value;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return cells;
}

/// `2.5s:velocity.speed=8`
std::optional<Change> parseChange(std::string_view text) {
    const std::size_t colon = text.find(':'), equals = text.find('=');
    if (colon == std::string_view::npos || equals == std::string_view::npos || equals < colon) return std::nullopt;
    std::string_view time = text.substr(0, colon);
    if (!time.ends_with('s')) return std::nullopt;
    time.remove_suffix(1);
    const auto seconds = parseNumber<double>(time);
    if (!seconds || !std::isfinite(*seconds) || *seconds < 0) return std::nullopt;
    Change change{*seconds == 0 ? 0 : *seconds, std::string(text.substr(colon + 1, equals - colon - 1)),
                  std::string(text.substr(equals + 1))};
    if (change.name.empty() || change.value.empty()) return std::nullopt;
    return change;
}

/// Changes separated by `;`, sorted by time.
std::optional<std::vector<Change>> parseChanges(std::string_view text) {
    std::vector<Change> changes;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(';'), text.size());
        auto change = parseChange(text.substr(0, end));
        if (!change) return std::nullopt;
        changes.push_back(*std::move(change));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    std::ranges::stable_sort(changes, {}, &Change::seconds);
    return changes;
}

/// True if `text` ends in one of the extensions, which are separated by `|`.
bool endsInOneOf(std::string_view extensions, std::string_view text) {
    for (;;) {
        const std::size_t end = extensions.find('|');
        if (text.ends_with(extensions.substr(0, end))) return true;
        if (end == std::string_view::npos) return false;
        extensions.remove_prefix(end + 1);
    }
}

bool isFile(const Parameter& parameter, std::string_view text) {
    const std::string& extensions = parameter.fileExtension;
    return !extensions.empty() && (text.find('/') != std::string_view::npos || endsInOneOf(extensions, text));
}

/// The canonical text of a value; empty if the declaration does not allow it.
std::optional<std::string> canonicalText(const Parameter& parameter, std::string_view text) {
    switch (parameter.type) {
        case ParameterType::integer: {
            const auto value = parseNumber<std::int64_t>(text);
            if (!value || static_cast<double>(*value) < parameter.minimum ||
                static_cast<double>(*value) > parameter.maximum)
                return std::nullopt;
            return std::to_string(*value);
        }
        case ParameterType::real: {
            const auto value = parseNumber<double>(text);
            if (!value || !std::isfinite(*value) || *value < parameter.minimum || *value > parameter.maximum)
                return std::nullopt;
            return numberText(*value == 0 ? 0 : *value);
        }
        case ParameterType::boolean:
            if (text == "on" || text == "true" || text == "1") return "on";
            if (text == "off" || text == "false" || text == "0") return "off";
            return std::nullopt;
        case ParameterType::choice:
            if (std::ranges::find(parameter.choices, text) != parameter.choices.end()) return std::string(text);
            if (parameter.choices.empty() && parameter.fileExtension.empty()) return std::string(text);
            if (isFile(parameter, text)) return std::filesystem::path(text).lexically_normal().string();
            return std::nullopt;
        case ParameterType::cells: {
            const auto value = parseCells(parameter, text);
            if (!value) return std::nullopt;
            return std::to_string((*value)[0]) + "x" + std::to_string((*value)[1]) + "x" + std::to_string((*value)[2]);
        }
        case ParameterType::changes: {
            const auto changes = parseChanges(text);
            if (!changes) return std::nullopt;
            std::string canonical;
            for (const Change& each : *changes)
                canonical.append(canonical.empty() ? "" : ";")
                    .append(numberText(each.seconds) + "s:" + each.name + "=" + each.value);
            return canonical;
        }
    }
    return std::nullopt;
}

}  // namespace

std::string Parameter::allowed() const {
    switch (type) {
        case ParameterType::integer:
            return "integer " + std::to_string(static_cast<std::int64_t>(minimum)) + ".." +
                   std::to_string(static_cast<std::int64_t>(maximum));
        case ParameterType::real:
            return "number " + numberText(minimum) + ".." + numberText(maximum);
        case ParameterType::boolean:
            return "on|off";
        case ParameterType::cells:
            return "a grid such as " + initial + ", " + numberText(minimum) + ".." + numberText(maximum) +
                   " cells along each edge";
        case ParameterType::changes:
            return "SECONDSs:NAME=VALUE, several separated by ';', at 0 s (the first recorded frame) or later";
        case ParameterType::choice:
            break;
    }
    if (choices.empty() && fileExtension.empty()) return "any text";
    std::string text;
    for (const std::string& option : choices) text += (text.empty() ? "" : "|") + option;
    return fileExtension.empty() ? text : text + "|FILE" + fileExtension;
}

ParameterSet& ParameterSet::add(Parameter parameter) {
    if (find(parameter.name)) throw std::logic_error("parameter '" + parameter.name + "' is declared twice");
    const auto canonical = canonicalText(parameter, parameter.initial);
    if (!canonical)
        throw std::logic_error("parameter '" + parameter.name + "': default '" + parameter.initial +
                               "' is not allowed: " + parameter.allowed());
    parameter.initial = *canonical;
    parameters_.push_back(std::move(parameter));
    return *this;
}

ParameterSet& ParameterSet::integer(std::string name, std::int64_t initial, std::int64_t minimum, std::int64_t maximum,
                                    std::string unit, std::string help) {
    return add({std::move(name),
                ParameterType::integer,
                std::to_string(initial),
                static_cast<double>(minimum),
                static_cast<double>(maximum),
                {},
                std::move(unit),
                std::move(help)});
}

ParameterSet& ParameterSet::real(std::string name, double initial, double minimum, double maximum, std::string unit,
                                 std::string help) {
    return add({std::move(name),
                ParameterType::real,
                numberText(initial),
                minimum,
                maximum,
                {},
                std::move(unit),
                std::move(help)});
}

ParameterSet& ParameterSet::boolean(std::string name, bool initial, std::string help) {
    return add({std::move(name), ParameterType::boolean, initial ? "on" : "off", 0, 1, {}, "", std::move(help)});
}

ParameterSet& ParameterSet::choice(std::string name, std::string initial, std::vector<std::string> choices,
                                   std::string help) {
    return add(
        {std::move(name), ParameterType::choice, std::move(initial), 0, 0, std::move(choices), "", std::move(help)});
}

ParameterSet& ParameterSet::dataFile(std::string name, std::string initial, std::string folder, std::string extension,
                                     std::vector<std::string> names, std::string help) {
    return add({std::move(name), ParameterType::choice, std::move(initial), 0, 0, std::move(names), "", std::move(help),
                std::move(folder), std::move(extension)});
}

ParameterSet& ParameterSet::cells(std::string name, std::string initial, std::int64_t minimum, std::int64_t maximum,
                                  std::string help) {
    return add({std::move(name),
                ParameterType::cells,
                std::move(initial),
                static_cast<double>(minimum),
                static_cast<double>(maximum),
                {},
                "",
                std::move(help)});
}

ParameterSet& ParameterSet::changes(std::string name, std::string help) {
    return add({std::move(name), ParameterType::changes, "", 0, 0, {}, "", std::move(help)});
}

ParameterSet& ParameterSet::preset(std::string_view name, std::string_view word,
                                   const std::vector<std::pair<std::string, std::string>>& defaults) {
    const auto choice = std::ranges::find(parameters_, name, &Parameter::name);
    if (choice == parameters_.end() || std::ranges::find(choice->choices, word) == choice->choices.end())
        throw std::logic_error("preset " + std::string(name) + "=" + std::string(word) + ": no such choice");
    Preset preset{std::string(name), std::string(word), {}};
    std::string listed;
    for (const auto& [other, text] : defaults) {
        const Parameter* parameter = find(other);
        const auto canonical = parameter ? canonicalText(*parameter, text) : std::nullopt;
        if (!canonical || other == name)
            throw std::logic_error("preset " + std::string(name) + "=" + std::string(word) + ": " + other + "=" + text +
                                   " is not allowed");
        preset.defaults.emplace_back(other, *canonical);
        listed.append(listed.empty() ? " (" : ", ").append(other + "=" + *canonical);
    }
    choice->help += "; " + preset.word + " sets other defaults" + listed + ")";
    presets_.push_back(std::move(preset));
    return *this;
}

const Parameter* ParameterSet::find(std::string_view name) const {
    const auto found = std::ranges::find(parameters_, name, &Parameter::name);
    return found == parameters_.end() ? nullptr : &*found;
}

ParameterValues::ParameterValues(const ParameterSet& declared) : declared_(declared) {
    for (const Parameter& parameter : declared.all()) values_[parameter.name] = parameter.initial;
}

void ParameterValues::set(std::string_view name, std::string_view text) {
    const Parameter* parameter = declared_.find(name);
    if (!parameter) {
        std::vector<std::string> known;
        for (const Parameter& each : declared_.all()) known.push_back(each.name);
        throw unknownName("parameter", name, known);
    }
    const auto canonical = canonicalText(*parameter, text);
    if (!canonical) {
        const std::string nearest = nearestName(text, parameter->choices);
        throw InputError("parameter " + std::string(name) + ": got '" + std::string(text) + "'" +
                         (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") +
                         ", allowed: " + parameter->allowed() + (parameter->unit.empty() ? "" : " " + parameter->unit));
    }
    values_.find(name)->second = *canonical;
    given_.emplace(name);
    applyPresets();
}

void ParameterValues::applyPresets() {
    for (const Preset& preset : declared_.presets())
        for (const auto& [name, text] : preset.defaults)
            if (!given_.contains(name)) values_[name] = declared_.find(name)->initial;
    for (const Preset& preset : declared_.presets()) {
        if (values_[preset.parameter] != preset.word) continue;
        for (const auto& [name, text] : preset.defaults)
            if (!given_.contains(name)) values_[name] = text;
    }
}

const std::string& ParameterValues::value(std::string_view name, ParameterType type) const {
    const Parameter* parameter = declared_.find(name);
    if (!parameter || parameter->type != type)
        throw std::logic_error("parameter '" + std::string(name) + "' is not declared with this type");
    return values_.find(name)->second;
}

std::int64_t ParameterValues::integer(std::string_view name) const {
    return *parseNumber<std::int64_t>(value(name, ParameterType::integer));
}

double ParameterValues::real(std::string_view name) const {
    return *parseNumber<double>(value(name, ParameterType::real));
}

bool ParameterValues::boolean(std::string_view name) const {
    return value(name, ParameterType::boolean) == "on";
}

const std::string& ParameterValues::choice(std::string_view name) const {
    return value(name, ParameterType::choice);
}

std::array<int, 3> ParameterValues::cells(std::string_view name) const {
    return *parseCells(*declared_.find(name), value(name, ParameterType::cells));
}

std::vector<Change> ParameterValues::changes(std::string_view name) const {
    return *parseChanges(value(name, ParameterType::changes));
}

const std::string& ParameterValues::choiceOf(std::string_view name, const std::vector<std::string>& words) const {
    const std::string& word = choice(name);
    if (declared_.find(name)->choices != words)
        throw std::logic_error("parameter '" + std::string(name) + "' is not declared with these choices");
    return word;
}

}  // namespace dustbench
