#include "methods/kit/particles/part.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"

namespace dustbench::particles {

/// Generated from the files of parts/, in no particular order.
std::vector<PartInfo> describeParts();

namespace {

std::pair<PartKind, std::string> place(const PartInfo& info) {
    return {info.kind, info.name};
}

/// Makes the parts that it creates know their name.
PartInfo naming(PartInfo info) {
    info.create = [name = info.name, create = std::move(info.create)](const ParameterValues& values) {
        std::unique_ptr<Part> part = create(values);
        part->setName(name);
        return part;
    };
    return info;
}

std::vector<PartInfo> sortedParts() {
    std::vector<PartInfo> parts = describeParts();
    std::ranges::transform(parts, parts.begin(), naming);
    std::ranges::sort(parts, {}, place);
    return parts;
}

std::vector<PartInfo>& allParts() {
    static std::vector<PartInfo> table = sortedParts();
    return table;
}

}  // namespace

Part::~Part() = default;

const std::vector<PartInfo>& partTable() {
    return allParts();
}

void requireNewPart(const PartInfo& info) {
    const auto same = std::ranges::find(allParts(), place(info), place);
    if (same != allParts().end())
        throw InputError(std::string(kindName(info.kind)) + " part '" + info.name + "' already exists, " +
                         (same->library.empty() ? "in this build" : "from " + same->library));
}

void addPart(PartInfo info) {
    requireNewPart(info);
    const auto at = std::ranges::lower_bound(allParts(), place(info), {}, place);
    allParts().insert(at, naming(std::move(info)));
}

const PartInfo& findPart(PartKind kind, std::string_view name) {
    std::vector<std::string> known;
    for (const PartInfo& info : partTable()) {
        if (info.kind != kind) continue;
        if (info.name == name) {
            if (!info.library.empty()) files::noteInput(info.library);
            return info;
        }
        known.push_back(info.name);
    }
    throw unknownName(std::string(kindName(kind)) + " part", name, known);
}

std::unique_ptr<Part> makePart(PartKind kind, std::string_view name, const NamedValues& values) {
    const PartInfo& info = findPart(kind, name);
    ParameterValues resolved(info.parameters);
    for (const auto& [key, text] : values) resolved.set(key, text);
    return info.create(resolved);
}

}  // namespace dustbench::particles
