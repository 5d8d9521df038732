// A mesh as stored in its file (polygons, not yet triangles), and the readers of the formats OBJ, PLY and STL.
//
// Units: as in the file; colours: sRGB, 8 bit.
// Formats: Wavefront, Advanced Visualizer, Appendix B1 (object files); 3D Systems, StereoLithography Interface
// Specification (1988).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
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

/// Reads the polygons of an OBJ file: v, vn and f. Texture coordinates, groups, materials, points and lines are checked
/// or skipped. Free-form surfaces and unknown keywords are errors, because the mesh would be incomplete. The comment
/// `# counts: v 642, f 1280` is our extension of the format: it gives the number of lines of each kind, so that a file
/// truncated between two lines is detected.
///
/// Normals are used if every face names one for each corner; positions are then pairs of vertex and normal. Throws
/// InputError with file and line.
[[nodiscard]] Polygons readObj(std::string_view text, const std::filesystem::path& file);

/// Reads the polygons of a PLY file, ASCII or binary, with its elements and properties in any order. Vertices have x,
/// y, z, and may have nx, ny, nz and red, green, blue (uchar), which faces may have too; faces have the list
/// vertex_indices or vertex_index. Everything else is checked and skipped.
///
/// The body must match the header exactly. Throws InputError with file and line, or with the element.
[[nodiscard]] Polygons readPly(std::string_view text, const std::filesystem::path& file);

/// Reads the triangles of an STL file, binary or ASCII. Corners at the same point become one vertex; facet normals are
/// checked but not used.
///
/// A binary file must have exactly 84 + 50 n bytes for its n triangles; an ASCII file must end with `endsolid` and a
/// line end. Throws InputError with file and line, or with the lengths.
[[nodiscard]] Polygons readStl(std::string_view text, const std::filesystem::path& file);

}  // namespace dustbench::meshes
