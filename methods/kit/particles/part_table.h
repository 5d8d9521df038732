// The table of all parts: what can be written in a particle system's file.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/kit/particles/part.h"

namespace dustbench::particles {

/// All parts, kind by kind, each kind by name.
[[nodiscard]] DUSTBENCH_API const std::vector<PartInfo>& partTable();

/// Throws InputError with the nearest name.
[[nodiscard]] DUSTBENCH_API const PartInfo& findPart(PartKind kind, std::string_view name);

using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// A part with its default parameters, but for those given. Throws InputError with what is allowed.
[[nodiscard]] DUSTBENCH_API std::unique_ptr<Part> makePart(PartKind kind, std::string_view name,
                                                           const NamedValues& values = {});

/// The same by the class of its kind, for who calls the part himself.
template <typename Kind>
[[nodiscard]] std::unique_ptr<Kind> makePartOf(PartKind kind, std::string_view name, const NamedValues& values = {}) {
    std::unique_ptr<Part> part = makePart(kind, name, values);
    return std::unique_ptr<Kind>(&dynamic_cast<Kind&>(*part.release()));
}

}  // namespace dustbench::particles
