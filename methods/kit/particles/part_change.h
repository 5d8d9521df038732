// Changes the parts of a running system by name: sets a parameter, or replaces, adds or removes a part.
//
//     velocity.speed = 8             a parameter of the single part of a kind
//     velocity.direction.x = 0.5     a component of a vector
//     velocity.part = random         another part of the kind, with default parameters
//     force.gravity.acceleration = 2 a parameter of a part in a list, by the part's name
//     force.2.acceleration = 2       or by its number in the list, from 1
//     force.gravity.part = wind      replaces the part; none: removes it
//     force.part = wind              adds a part
//
// Source: Thesis, 3.1.1 and 3.1.3 (every parameter and every part can be changed at any time).
#pragma once

#include <string_view>

#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

/// Throws InputError for an unknown name (with the nearest one), a value that is not allowed, or a change that would
/// make the system invalid; the list is then unchanged.
DUSTBENCH_API void changePart(PartList& parts, std::string_view name, std::string_view value);

/// Scales every length of the part that sets sizes. Throws InputError if a length leaves its range.
DUSTBENCH_API void scaleSizes(PartList& parts, double factor);

}  // namespace dustbench::particles
