#include "tests/architecture/own_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <sstream>
#include <tuple>

namespace dustbench::architecture {
namespace {

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string firstWord(std::string_view text) {
    return {text.begin(), std::ranges::find_if_not(text, isWordCharacter)};
}

/// The rest after `start`, or nothing if the text does not begin with it.
std::optional<std::string_view> after(std::string_view line, std::string_view start) {
    if (!line.starts_with(start)) return std::nullopt;
    return line.substr(start.size());
}

/// `std::map<a, b> f(int)` without the text in angle brackets.
std::string withoutArguments(std::string_view line) {
    std::string kept;
    int depth = 0;
    for (const char c : line) {
        const bool closes = c == '>' && depth > 0;
        if (c == '<') ++depth;
        if (depth == 0) kept += c;
        if (closes) --depth;
    }
    return kept;
}

/// The function or variable that a line declares; empty if none or a member of a class.
std::string declaredName(std::string_view line) {
    const std::string text = withoutArguments(line);
    const std::size_t end = std::min(text.find_first_of("(={[;"), text.size());
    std::size_t last = end;
    while (last > 0 && text[last - 1] == ' ') --last;
    std::size_t first = last;
    while (first > 0 && isWordCharacter(text[first - 1])) --first;
    const bool isAfterType = first > 0 && (text[first - 1] == ' ' || text[first - 1] == '*' || text[first - 1] == '&');
    return isAfterType && end < text.size() ? text.substr(first, last - first) : "";
}

std::string nameIn(std::string_view line) {
    static constexpr std::array<std::string_view, 4> types{"struct ", "class ", "enum class ", "union "};
    for (const std::string_view type : types)
        if (const auto rest = after(line, type)) return firstWord(*rest);
    if (const auto rest = after(line, "using ")) return rest->find('=') == rest->npos ? "" : firstWord(*rest);
    if (after(line, "namespace ") || after(line, "template ")) return "";
    return declaredName(line);
}

/// The unit that is compiled together: a folder with its `parts/`, and whether it is a module, tests or benchmarks.
std::string moduleOf(const std::string& path) {
    const std::string folder = path.substr(0, std::min(path.find("/parts/"), path.rfind('/')));
    return folder + (path.ends_with("_test.cpp") ? " tests" : path.ends_with("_bench.cpp") ? " benchmarks" : "");
}

}  // namespace

std::vector<OwnName> ownNames(std::string_view text) {
    std::vector<OwnName> names;
    std::istringstream lines{std::string(text)}, codeLines(codeOnly(text));
    std::string space;
    bool isUnnamed = false;
    std::size_t number = 0;
    for (std::string line, whole; std::getline(codeLines, line) && std::getline(lines, whole);) {
        ++number;
        while (line.ends_with(' ')) line.pop_back();
        if (line == "namespace {") {
            isUnnamed = true;
        } else if (const auto named = after(line, "namespace "); named && named->ends_with(" {")) {
            space = named->substr(0, named->size() - 2);
        } else if (whole == "}  // namespace") {
            isUnnamed = false;
        } else if (isUnnamed && !line.empty() && std::isalpha(static_cast<unsigned char>(line.front()))) {
            if (std::string name = nameIn(line); !name.empty()) names.push_back({std::move(name), space, number});
        }
    }
    return names;
}

Faults sharedNameFaults(const std::vector<SourceFile>& files) {
    std::map<std::tuple<std::string, std::string, std::string>, const SourceFile*> declaredBy;
    Faults faults;
    for (const SourceFile& file : files) {
        if (!file.path.ends_with(".cpp")) continue;
        for (const OwnName& own : ownNames(file.text)) {
            const auto [first, isNew] = declaredBy.try_emplace({moduleOf(file.path), own.space, own.name}, &file);
            if (!isNew && first->second != &file)
                faults.push_back(file.path + ":" + std::to_string(own.line) + ": '" + own.name +
                                 "' is also a name in " + first->second->path + ", with which it may be compiled");
        }
    }
    return faults;
}

}  // namespace dustbench::architecture
