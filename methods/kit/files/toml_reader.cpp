#include "methods/kit/files/toml_reader.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/toml_nesting.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::files {

/// All readers of a document's tables share the document; `table` points into it.
struct TomlReader::State {
    std::shared_ptr<const toml::table> document;
    const toml::table* table;
    std::string file;
    std::string path;  ///< path of the table within the document, for messages
    std::set<std::string, std::less<>> known;
    std::set<std::string, std::less<>> asked;  ///< looked for but not read; known even if missing
};

namespace {

std::string describe(const toml::node& node) {
    if (node.is_table()) return "a table";
    if (node.is_array()) return "an array";
    std::ostringstream text;
    node.visit([&](const auto& value) {
        if constexpr (!toml::is_table<decltype(value)> && !toml::is_array<decltype(value)>) text << value;
    });
    return text.str();
}

std::string join(const std::vector<std::string>& names, const char* separator) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
    return text;
}

}  // namespace

TomlReader::TomlReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
TomlReader::TomlReader(TomlReader&&) noexcept = default;
TomlReader& TomlReader::operator=(TomlReader&&) noexcept = default;
TomlReader::~TomlReader() = default;

TomlReader TomlReader::parseText(std::string_view text, std::string name) {
    if (const std::size_t line = tooDeepLine(text, limits::tomlLevels); line > 0)
        throw InputError(fmt::format("{}:{}: tables and arrays nest too deeply, allowed: {} levels", name, line,
                                     limits::tomlLevels));
    try {
        auto document = std::make_shared<const toml::table>(toml::parse(text, name));
        return TomlReader(std::make_unique<State>(State{document, document.get(), std::move(name), "", {}, {}}));
    } catch (const toml::parse_error& error) {
        throw InputError(
            fmt::format("{}:{}: not valid TOML: {}", name, error.source().begin.line, error.description()));
    }
}

TomlReader TomlReader::parseFile(const std::filesystem::path& file) {
    const std::string text = wholeText(file, "a TOML file");
    noteInput(file);
    return parseText(text, file.string());
}

std::string TomlReader::where(std::string_view key) const {
    const toml::node* node = key.empty() ? nullptr : state_->table->get(key);
    const auto line = (node ? node->source() : state_->table->source()).begin.line;
    return fmt::format("{}:{}: ", state_->file, std::max<std::uint32_t>(line, 1));
}

bool TomlReader::has(std::string_view key) const {
    state_->asked.emplace(key);
    return state_->table->contains(key);
}

std::vector<std::string> TomlReader::keys() const {
    std::vector<std::pair<toml::source_position, std::string>> sorted;
    for (const auto& [key, node] : *state_->table) sorted.emplace_back(key.source().begin, key.str());
    std::ranges::sort(sorted, [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> list;
    list.reserve(sorted.size());
    for (auto& [position, key] : sorted) list.push_back(std::move(key));
    return list;
}

namespace {

/// Returns the node under a key; throws if it is missing.
const toml::node& require(const TomlReader& reader, const toml::table& table, std::string_view key,
                          std::string_view path, std::string_view expected) {
    if (const toml::node* node = table.get(key)) return *node;
    throw InputError(fmt::format("{}key '{}{}' is missing, expected {}", reader.where(), path, key, expected));
}

[[noreturn]] void refuse(const TomlReader& reader, std::string_view path, std::string_view key, const toml::node& node,
                         std::string_view expected) {
    throw InputError(
        fmt::format("{}key '{}{}': got {}, expected {}", reader.where(key), path, key, describe(node), expected));
}

}  // namespace

double TomlReader::number(std::string_view key, double minimum, double maximum) {
    state_->known.emplace(key);
    const std::string expected = fmt::format("a number {}..{}", minimum, maximum);
    const toml::node& node = require(*this, *state_->table, key, state_->path, expected);
    const auto value = node.value<double>();
    if (!node.is_number() || !value || !std::isfinite(*value) || *value < minimum || *value > maximum)
        refuse(*this, state_->path, key, node, expected);
    return *value;
}

double TomlReader::number(std::string_view key, double minimum, double maximum, double initial) {
    state_->known.emplace(key);
    return has(key) ? number(key, minimum, maximum) : initial;
}

std::int64_t TomlReader::integer(std::string_view key, std::int64_t minimum, std::int64_t maximum) {
    state_->known.emplace(key);
    const std::string expected = fmt::format("an integer {}..{}", minimum, maximum);
    const toml::node& node = require(*this, *state_->table, key, state_->path, expected);
    const auto* value = node.as_integer();
    if (!value || value->get() < minimum || value->get() > maximum) refuse(*this, state_->path, key, node, expected);
    return value->get();
}

std::int64_t TomlReader::integer(std::string_view key, std::int64_t minimum, std::int64_t maximum,
                                 std::int64_t initial) {
    state_->known.emplace(key);
    return has(key) ? integer(key, minimum, maximum) : initial;
}

std::string TomlReader::text(std::string_view key) {
    state_->known.emplace(key);
    const toml::node& node = require(*this, *state_->table, key, state_->path, "a text");
    const auto* value = node.as_string();
    if (!value) refuse(*this, state_->path, key, node, "a text");
    return value->get();
}

std::string TomlReader::text(std::string_view key, std::string initial) {
    state_->known.emplace(key);
    return has(key) ? text(key) : std::move(initial);
}

bool TomlReader::boolean(std::string_view key, bool initial) {
    state_->known.emplace(key);
    if (!has(key)) return initial;
    const toml::node& node = *state_->table->get(key);
    const auto* value = node.as_boolean();
    if (!value) refuse(*this, state_->path, key, node, "true or false");
    return value->get();
}

std::string TomlReader::choice(std::string_view key, const std::vector<std::string>& allowed) {
    const std::string expected = "one of " + join(allowed, ", ");
    state_->known.emplace(key);
    const toml::node& node = require(*this, *state_->table, key, state_->path, expected);
    const auto* value = node.as_string();
    if (!value || std::ranges::find(allowed, value->get()) == allowed.end()) {
        const std::string nearest = value ? nearestName(value->get(), allowed) : "";
        refuse(*this, state_->path, key, node,
               expected + (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
    }
    return value->get();
}

glm::dvec3 TomlReader::vector3(std::string_view key) {
    const std::vector<double> values = numbers(key, 3);
    if (values.size() != 3) refuse(*this, state_->path, key, *state_->table->get(key), "three numbers [x, y, z]");
    return {values[0], values[1], values[2]};
}

glm::dvec3 TomlReader::vector3(std::string_view key, glm::dvec3 initial) {
    state_->known.emplace(key);
    return has(key) ? vector3(key) : initial;
}

std::vector<double> TomlReader::numbers(std::string_view key, std::size_t minimum) {
    state_->known.emplace(key);
    const std::string expected = fmt::format("an array of {} or more numbers", minimum);
    const toml::node& node = require(*this, *state_->table, key, state_->path, expected);
    const toml::array* array = node.as_array();
    if (!array || array->size() < minimum) refuse(*this, state_->path, key, node, expected);
    std::vector<double> values;
    for (const toml::node& element : *array) {
        const auto value = element.value<double>();
        if (!element.is_number() || !std::isfinite(*value)) refuse(*this, state_->path, key, element, expected);
        values.push_back(*value);
    }
    return values;
}

std::vector<std::string> TomlReader::texts(std::string_view key) {
    state_->known.emplace(key);
    const std::string expected = "a text or an array of texts";
    const toml::node& node = require(*this, *state_->table, key, state_->path, expected);
    if (const auto* value = node.as_string()) return {value->get()};
    const toml::array* array = node.as_array();
    if (!array) refuse(*this, state_->path, key, node, expected);
    std::vector<std::string> values;
    for (const toml::node& element : *array) {
        const auto* value = element.as_string();
        if (!value) refuse(*this, state_->path, key, element, expected);
        values.push_back(value->get());
    }
    return values;
}

std::vector<std::string> TomlReader::scalars(std::string_view key) {
    state_->known.emplace(key);
    const std::string expected = "a number, text or boolean, or an array of them";
    const toml::node& node = require(*this, *state_->table, key, state_->path, expected);
    const auto scalar = [&](const toml::node& element) -> std::string {
        if (const auto* value = element.as_string()) return value->get();
        if (const auto* value = element.as_integer()) return std::to_string(value->get());
        if (const auto* value = element.as_floating_point()) return fmt::format("{}", value->get());
        if (const auto* value = element.as_boolean()) return value->get() ? "on" : "off";
        refuse(*this, state_->path, key, element, expected);
    };
    const toml::array* array = node.as_array();
    if (!array) return {scalar(node)};
    std::vector<std::string> values;
    for (const toml::node& element : *array) values.push_back(scalar(element));
    return values;
}

TomlReader TomlReader::table(std::string_view key) {
    state_->known.emplace(key);
    const toml::node& node = require(*this, *state_->table, key, state_->path, "a table");
    const toml::table* table = node.as_table();
    if (!table) refuse(*this, state_->path, key, node, "a table");
    return TomlReader(std::make_unique<State>(
        State{state_->document, table, state_->file, state_->path + std::string(key) + ".", {}, {}}));
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) {
    state_->known.emplace(key);
    std::vector<TomlReader> list;
    const toml::node* node = state_->table->get(key);
    if (!node) return list;
    const toml::array* array = node->as_array();
    if (!array) refuse(*this, state_->path, key, *node, fmt::format("tables [[{}{}]]", state_->path, key));
    for (const toml::node& element : *array) {
        const toml::table* table = element.as_table();
        if (!table) refuse(*this, state_->path, key, element, fmt::format("tables [[{}{}]]", state_->path, key));
        list.push_back(TomlReader(std::make_unique<State>(
            State{state_->document, table, state_->file, state_->path + std::string(key) + ".", {}, {}})));
    }
    return list;
}

void TomlReader::finish() const {
    std::vector<std::string> known;
    std::ranges::set_union(state_->known, state_->asked, std::back_inserter(known));
    for (const std::string& key : keys())
        if (!state_->known.contains(key))
            throw InputError(where(key) +
                             unknownName(state_->path.empty()
                                             ? "key"
                                             : "key in [" + state_->path.substr(0, state_->path.size() - 1) + "]",
                                         key, known)
                                 .what());
}

}  // namespace dustbench::files
