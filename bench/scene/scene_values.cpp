#include "bench/scene/scene_values.h"

#include <string>

#include "methods/contract/errors.h"

namespace dustbench::bench {

using files::TomlReader;

double readAngle(TomlReader& table, std::string_view key, double minimum, double maximum, double initial) {
    return glm::radians(table.number(key, minimum, maximum, glm::degrees(initial)));
}

glm::dvec3 readBounded(TomlReader& table, std::string_view key, glm::dvec3 initial, double minimum, double maximum,
                       const char* expected) {
    const glm::dvec3 value = table.vector3(key, initial);
    for (int i = 0; i < 3; ++i)
        if (value[i] < minimum || value[i] > maximum)
            throw InputError(table.where(key) + "key '" + std::string(key) + "': expected " + expected);
    return value;
}

glm::vec3 readColour(TomlReader& table, std::string_view key, glm::vec3 initial, double maximum) {
    return readBounded(table, key, initial, 0, maximum,
                       maximum == 1 ? "a linear RGB colour, each 0..1" : "a linear RGB colour, each 0..100");
}

glm::dvec3 readPoint(TomlReader& table, std::string_view key, glm::dvec3 initial) {
    return readBounded(table, key, initial, -1e5, 1e5, "three numbers -100000..100000, metres");
}

}  // namespace dustbench::bench
