// What is asked for when volumes are exported: which frames, in which formats, how fine and of which region.
//
// Units: metres. Frame: world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/export/frame_range.h"

namespace dustbench::bench {

/// vti: extinction on a grid; htg: the octree itself; vtp: the particles; vdb: the grid for OpenVDB.
enum class VolumeFormat { vti, htg, vtp, vdb };
[[nodiscard]] std::string_view formatName(VolumeFormat format);
/// `vti,htg`: each once, in the order of the enumeration. Throws InputError.
[[nodiscard]] std::vector<VolumeFormat> parseFormats(std::string_view text);
[[nodiscard]] std::string formatsText(const std::vector<VolumeFormat>& formats);

enum class VdbPrecision { half, single };
/// `half` or `float`.
[[nodiscard]] std::string_view precisionName(VdbPrecision precision);
/// Throws InputError.
[[nodiscard]] VdbPrecision parsePrecision(std::string_view text);

struct Box {
    glm::dvec3 least{0};
    glm::dvec3 most{0};

    [[nodiscard]] glm::dvec3 extent() const { return most - least; }
    void include(const Box& other) {
        least = glm::min(least, other.least);
        most = glm::max(most, other.most);
    }
};
/// `x0,y0,z0,x1,y1,z1`. Throws InputError.
[[nodiscard]] Box parseRegion(std::string_view text);
[[nodiscard]] std::string regionText(const Box& region);

inline constexpr int mostCellsPerEdge = 2048;
/// Throws InputError.
[[nodiscard]] int parseResolution(std::string_view text);

struct VolumeSettings {
    FrameRange frames;
    std::vector<VolumeFormat> formats{VolumeFormat::vti};
    int resolution = 128;       ///< cells along the longest edge of a grid, 1..mostCellsPerEdge
    std::optional<Box> region;  ///< of grids; none: what the cloud fills, frame by frame
    VdbPrecision vdbPrecision = VdbPrecision::half;

    [[nodiscard]] bool wants(VolumeFormat format) const;
};

}  // namespace dustbench::bench
