// The table of all parts that a particle system's file can use.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/kit/particles/part.h"

namespace dustbench::particles {

/// All parts, ordered by kind and name.
[[nodiscard]] DUSTBENCH_API const std::vector<PartInfo>& partTable();

/// Throws InputError if a part of this kind and name exists.
DUSTBENCH_API void requireNewPart(const PartInfo& info);
/// Adds a part from a library, with `library` set. References into partTable() become invalid. Throws as above.
DUSTBENCH_API void addPart(PartInfo info);

/// Notes the part's library as an input of the run. Throws InputError, which suggests the nearest name.
[[nodiscard]] DUSTBENCH_API const PartInfo& findPart(PartKind kind, std::string_view name);

using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// A part with default parameters, except for the given values. Throws InputError with the values allowed.
[[nodiscard]] DUSTBENCH_API std::unique_ptr<Part> makePart(PartKind kind, std::string_view name,
                                                           const NamedValues& values = {});

/// The same with the class of its kind, for callers that use the part directly.
template <typename Kind>
[[nodiscard]] std::unique_ptr<Kind> makePartOf(PartKind kind, std::string_view name, const NamedValues& values = {}) {
    std::unique_ptr<Part> part = makePart(kind, name, values);
    return std::unique_ptr<Kind>(&dynamic_cast<Kind&>(*part.release()));
}

}  // namespace dustbench::particles
