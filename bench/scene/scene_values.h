// Reads values that several tables of a scene file contain: angles, colours, points.
//
// Units in the file: m, degrees; colours linear RGB. All throw InputError with file, line and what was expected.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {

/// In radians; the bounds are in degrees, as in the file.
[[nodiscard]] double readAngle(files::TomlReader& table, std::string_view key, double minimum, double maximum,
                               double initial);
/// Three numbers within bounds; `expected` describes them in messages.
[[nodiscard]] glm::dvec3 readBounded(files::TomlReader& table, std::string_view key, glm::dvec3 initial, double minimum,
                                     double maximum, const char* expected);
/// Each channel 0..`maximum`, which is 1 or 100.
[[nodiscard]] glm::vec3 readColour(files::TomlReader& table, std::string_view key, glm::vec3 initial, double maximum);
/// Within 100 km of the world's origin along each axis.
[[nodiscard]] glm::dvec3 readPoint(files::TomlReader& table, std::string_view key, glm::dvec3 initial);

}  // namespace dustbench::bench
