// A mesh as stored in its file: polygons, not yet triangles.
//
// Units: as in the file; colours: sRGB, 8 bit.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace dustbench::meshes {

using Colour8 = std::array<std::uint8_t, 3>;

struct Polygons {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      ///< one per position, or none
    std::vector<Colour8> colours;        ///< one per position, or none
    std::vector<Colour8> faceColours;    ///< one per polygon, or none
    std::vector<std::uint32_t> corners;  ///< indices of positions, polygon by polygon
    std::vector<std::size_t> ends;       ///< end of each polygon in `corners`
    std::vector<std::string> ignored;    ///< other contents of the file: `property 's' of vertex`

    [[nodiscard]] std::size_t size() const { return ends.size(); }
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t polygon) const {
        const std::size_t first = polygon == 0 ? 0 : ends[polygon - 1];
        return std::span(corners).subspan(first, ends[polygon] - first);
    }
};

}  // namespace dustbench::meshes
