// The header of a PLY file: the elements of the body and their storage formats.
//
// Format: Turk, The PLY Polygon File Format (1994).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/meshes/mesh_text.h"

namespace dustbench::meshes {

struct PlyType {
    enum class Kind { signedInteger, unsignedInteger, floating };
    Kind kind = Kind::floating;
    std::size_t bytes = 0;
    std::string_view name;

    [[nodiscard]] bool isInteger() const { return kind != Kind::floating; }
};

struct PlyProperty {
    std::string name;
    PlyType type;
    bool isList = false;
    PlyType countType{};  ///< of a list: an integer
};

struct PlyElement {
    std::string name;
    std::int64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Index of the property, or -1.
    [[nodiscard]] int find(std::string_view property) const;
};

enum class PlyFormat { ascii, littleEndian, bigEndian };

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
};

/// Names of elements, and of properties within an element, must be unique; a non-empty element must have properties.
/// Throws InputError with file and line.
[[nodiscard]] PlyHeader readPlyHeader(Lines& lines);

}  // namespace dustbench::meshes
