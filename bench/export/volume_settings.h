// Settings of a volume export: frames, formats, resolution and region.
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
#include "methods/contract/choices.h"

namespace dustbench::bench {

/// vti: extinction on a grid; htg: the octree itself; vtp: the particles; vdb: the grid for OpenVDB.
enum class VolumeFormat { vti, htg, vtp, vdb };
inline constexpr Choices<VolumeFormat> volumeFormats{
    {"vti", VolumeFormat::vti}, {"htg", VolumeFormat::htg}, {"vtp", VolumeFormat::vtp}, {"vdb", VolumeFormat::vdb}};
/// `vti,htg`: each once, in the order of the enumeration. Throws InputError.
[[nodiscard]] std::vector<VolumeFormat> parseFormats(std::string_view text);
[[nodiscard]] std::string formatsText(const std::vector<VolumeFormat>& formats);

enum class VdbPrecision { half, single };
inline constexpr Choices<VdbPrecision> vdbPrecisions{{"half", VdbPrecision::half}, {"float", VdbPrecision::single}};

struct Box {
    glm::dvec3 minimum{0};
    glm::dvec3 maximum{0};

    [[nodiscard]] glm::dvec3 extent() const { return maximum - minimum; }
    void include(const Box& other) {
        minimum = glm::min(minimum, other.minimum);
        maximum = glm::max(maximum, other.maximum);
    }
};
/// `x0,y0,z0,x1,y1,z1`. Throws InputError.
[[nodiscard]] Box parseRegion(std::string_view text);
[[nodiscard]] std::string regionText(const Box& region);

inline constexpr int maximumCellsPerEdge = 2048;
/// Throws InputError.
[[nodiscard]] int parseResolution(std::string_view text);

struct VolumeSettings {
    FrameRange frames;
    std::vector<VolumeFormat> formats{VolumeFormat::vti};
    int resolution = 128;       ///< cells along the longest edge of a grid, 1..maximumCellsPerEdge
    std::optional<Box> region;  ///< of grids; empty: the cloud's bounding box in each frame
    VdbPrecision vdbPrecision = VdbPrecision::half;

    [[nodiscard]] bool wants(VolumeFormat format) const;
};

}  // namespace dustbench::bench
