#include "methods/kit/particles/part_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {
namespace {

template <typename Kind>
std::unique_ptr<Kind> as(std::unique_ptr<Part> part) {
    return std::unique_ptr<Kind>(&dynamic_cast<Kind&>(*part.release()));
}

bool givesLifetimes(const std::unique_ptr<LifePart>& part) {
    return part->meanLifetimeSeconds().has_value();
}

template <typename Kind>
void replace(std::unique_ptr<Kind>& place, std::unique_ptr<Part> part) {
    if (place) part->takeOver(*place);
    place = as<Kind>(std::move(part));
}

template <typename Kind>
void replaceOrRemove(PartList::List<Kind>& list, std::size_t index, std::unique_ptr<Part> part) {
    if (part)
        replace(list.at(index), std::move(part));
    else
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace

void PartList::set(std::unique_ptr<Part> part) {
    switch (part->kind()) {
        case PartKind::emission:
            replace(emission_, std::move(part));
            return;
        case PartKind::position:
            replace(position_, std::move(part));
            return;
        case PartKind::velocity:
            replace(velocity_, std::move(part));
            return;
        case PartKind::colour:
            replace(colour_, std::move(part));
            return;
        case PartKind::size:
            replace(size_, std::move(part));
            return;
        case PartKind::render:
            replace(render_, std::move(part));
            return;
        case PartKind::life:
            lives_.push_back(as<LifePart>(std::move(part)));
            return;
        case PartKind::shading:
            shadings_.push_back(as<ShadingPart>(std::move(part)));
            return;
        case PartKind::force:
            forces_.push_back(as<ForcePart>(std::move(part)));
            return;
        case PartKind::event:
            events_.push_back(as<EventPart>(std::move(part)));
            return;
    }
}

void PartList::setInList(PartKind kind, std::size_t index, std::unique_ptr<Part> part) {
    if (kind == PartKind::life) return replaceOrRemove(lives_, index, std::move(part));
    if (kind == PartKind::shading) return replaceOrRemove(shadings_, index, std::move(part));
    if (kind == PartKind::force) return replaceOrRemove(forces_, index, std::move(part));
    if (kind == PartKind::event) return replaceOrRemove(events_, index, std::move(part));
    throw std::logic_error("a part of kind '" + std::string(kindName(kind)) + "' is not in a list");
}

void PartList::takeOver(const PartList& before) {
    const std::vector<Part*> own = mutableParts();
    const std::vector<const Part*> old = before.all();
    for (std::size_t i = 0, k = 0; i < own.size(); ++i) {
        while (k < old.size() && old[k]->kind() < own[i]->kind()) ++k;
        if (k < old.size() && old[k]->kind() == own[i]->kind()) own[i]->takeOver(*old[k++]);
    }
}

const LifePart& PartList::lifetime() const {
    const auto found = std::ranges::find_if(lives_, givesLifetimes);
    if (found == lives_.end()) throw std::logic_error("no part sets lifetimes");
    return **found;
}

std::vector<Part*> PartList::mutableParts() const {
    std::vector<Part*> parts;
    for (Part* part : std::initializer_list<Part*>{emission_.get(), position_.get(), velocity_.get(), colour_.get(),
                                                   size_.get(), render_.get()})
        if (part) parts.push_back(part);
    for (const auto& part : lives_) parts.push_back(part.get());
    for (const auto& part : shadings_) parts.push_back(part.get());
    for (const auto& part : forces_) parts.push_back(part.get());
    for (const auto& part : events_) parts.push_back(part.get());
    return parts;
}

std::vector<const Part*> PartList::all() const {
    const std::vector<Part*> parts = mutableParts();
    return {parts.begin(), parts.end()};
}

std::string PartList::missing() const {
    const auto none = [](PartKind kind) { return "no part of kind '" + std::string(kindName(kind)) + "'"; };
    if (!emission_) return none(PartKind::emission);
    if (!position_) return none(PartKind::position);
    if (!velocity_) return none(PartKind::velocity);
    if (!colour_) return none(PartKind::colour);
    if (!size_) return none(PartKind::size);
    const auto lifetimes = std::ranges::count_if(lives_, givesLifetimes);
    if (lifetimes == 0) return "no part of kind 'life' that sets lifetimes ('lifetime')";
    if (lifetimes > 1) return "more than one part of kind 'life' that sets lifetimes";
    const auto settling = std::ranges::count_if(forces_, [](const auto& force) { return force->settles(); });
    if (settling > 1) return "more than one part of kind 'force' that sets positions, such as 'springs'";
    for (const Part* part : all())
        if (part->needsLattice() && !position_->lattice())
            return std::string(kindName(part->kind())) + " '" + part->name() + "': got the position '" +
                   position_->name() + "', allowed: 'lattice'";
    return {};
}

// --- Changes by name.

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
