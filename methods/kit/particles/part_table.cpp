#include "methods/kit/particles/part_table.h"

#include <algorithm>

#include "methods/contract/errors.h"

namespace dustbench::particles {

/// Generated from the files of parts/, in no particular order.
std::vector<PartInfo> describeParts();

namespace {

std::vector<PartInfo> sortedParts() {
    std::vector<PartInfo> parts = describeParts();
    std::ranges::sort(parts, {}, [](const PartInfo& info) { return std::pair(info.kind, info.name); });
    return parts;
}

}  // namespace

Part::~Part() = default;

const std::vector<PartInfo>& partTable() {
    static const std::vector<PartInfo> table = sortedParts();
    return table;
}

const PartInfo& findPart(PartKind kind, std::string_view name) {
    std::vector<std::string> known;
    for (const PartInfo& info : partTable()) {
        if (info.kind != kind) continue;
        if (info.name == name) return info;
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
