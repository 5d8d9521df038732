#include "methods/kit/particles/part_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part_table.h"

namespace dustbench::particles {
namespace {

constexpr std::string_view partKey = "part", none = "none";

/// Cuts `text` at its first point and returns the part before it.
std::string_view cutFirst(std::string_view& text) {
    const std::string_view first = text.substr(0, text.find('.'));
    text.remove_prefix(std::min(first.size() + 1, text.size()));
    return first;
}

PartKind kindOf(std::string_view word) {
    const auto found = std::ranges::find(partKindNames, word);
    if (found == partKindNames.end())
        throw unknownName("kind of part", word, std::vector<std::string>(partKindNames.begin(), partKindNames.end()));
    return static_cast<PartKind>(found - partKindNames.begin());
}

std::vector<const Part*> partsOf(const PartList& parts, PartKind kind) {
    std::vector<const Part*> found;
    for (const Part* part : parts.all())
        if (part->kind() == kind) found.push_back(part);
    return found;
}

/// The index in its list of the part that `word` names or numbers.
std::size_t placeOf(std::span<const Part* const> list, PartKind kind, std::string_view word) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc() && end == word.data() + word.size() && number >= 1 && number <= list.size())
        return number - 1;
    std::vector<std::string> known;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i]->name() == word) return i;
        known.push_back(list[i]->name());
    }
    throw unknownName(std::string(kindName(kind)) + " part in this system", word, known);
}

std::unique_ptr<Part> withValue(const Part& part, std::string_view key, std::string_view value) {
    const ParameterSet& declared = part.values().declared();
    if (!declared.find(key)) {
        std::vector<std::string> known{std::string(partKey)};
        for (const Parameter& each : declared.all()) known.push_back(each.name);
        throw unknownName("parameter of '" + part.name() + "'", key, known);
    }
    ParameterValues values = part.values();
    values.set(key, value);
    return findPart(part.kind(), part.name()).create(values);
}

std::unique_ptr<Part> changed(const Part& part, std::string_view key, std::string_view value) {
    return key == partKey ? makePart(part.kind(), value) : withValue(part, key, value);
}

/// Checks that the list remains a valid system with `part` (null: none) at `index` (the end: appended).
void requireLifetimes(std::span<const Part* const> list, std::size_t index, const Part* part) {
    int giving = 0;
    for (std::size_t i = 0; i <= list.size(); ++i) {
        const Part* stays = i == index ? part : i < list.size() ? list[i] : nullptr;
        if (stays && static_cast<const LifePart*>(stays)->meanLifetimeSeconds()) ++giving;
    }
    if (giving != 1)
        throw InputError("parts of kind 'life' that set lifetimes: got " + std::to_string(giving) + ", expected 1");
}

void changeList(PartList& parts, PartKind kind, std::string_view rest, std::string_view value) {
    const std::vector<const Part*> list = partsOf(parts, kind);
    std::size_t index = list.size();
    std::unique_ptr<Part> part;
    if (rest == partKey) {
        part = makePart(kind, value);
    } else {
        index = placeOf(list, kind, cutFirst(rest));
        if (rest != partKey || value != none) part = changed(*list[index], rest, value);
    }
    if (kind == PartKind::life) requireLifetimes(list, index, part.get());
    if (index == list.size())
        parts.set(std::move(part));
    else
        parts.setInList(kind, index, std::move(part));
}

void changeSingle(PartList& parts, PartKind kind, std::string_view key, std::string_view value) {
    const std::vector<const Part*> found = partsOf(parts, kind);
    if (!found.empty()) return parts.set(changed(*found.front(), key, value));
    if (key != partKey)
        throw InputError("the system has no part of kind '" + std::string(kindName(kind)) + "', expected " +
                         std::string(kindName(kind)) + ".part=NAME first");
    parts.set(makePart(kind, value));
}

}  // namespace

void changePart(PartList& parts, std::string_view name, std::string_view value) {
    std::string_view rest = name;
    const PartKind kind = kindOf(cutFirst(rest));
    const bool complete = parts.missing().empty();
    isList(kind) ? changeList(parts, kind, rest, value) : changeSingle(parts, kind, rest, value);
    if (const std::string missing = parts.missing(); complete && !missing.empty()) throw InputError(missing);
}

void scaleSizes(PartList& parts, double factor) {
    const Part* size = parts.size();
    if (factor == 1 || !size) return;
    NamedValues scaled;
    for (const Parameter& parameter : size->values().declared().all())
        scaled.emplace_back(parameter.name, parameter.unit == "m"
                                                ? fmt::format("{}", factor * size->values().real(parameter.name))
                                                : size->values().canonical().at(parameter.name));
    parts.set(makePart(PartKind::size, size->name(), scaled));
}

}  // namespace dustbench::particles
