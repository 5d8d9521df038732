// Settings of a volume export: frames, formats, resolution and region, and their texts.
//
// Units: metres. Frame: world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dustbench::exports {

/// The frames of a run to export. Never empty: `first` is always included.
struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;  ///< the last frame included
    std::int64_t step = 1;

    [[nodiscard]] bool contains(std::int64_t frame) const {
        return frame >= first && frame <= last && (frame - first) % step == 0;
    }
    [[nodiscard]] std::int64_t count() const { return (last - first) / step + 1; }
    /// `A:B:STEP`; equal ranges have equal text.
    [[nodiscard]] std::string text() const;
};

/// `A:B:STEP` excluding B, `A:B` for every frame, or only `A`. Throws InputError with a message starting with `what`.
[[nodiscard]] FrameRange parseFrameRange(std::string_view what, std::string_view text);

/// `vti,htg`: ids of exporters (exporter.h), each once, in their order. Throws InputError.
[[nodiscard]] std::vector<std::string> parseFormats(std::string_view text);
[[nodiscard]] std::string formatsText(const std::vector<std::string>& formats);

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
    std::vector<std::string> formats{"vti"};
    int resolution = 128;                          ///< cells along the longest edge of a grid, 1..maximumCellsPerEdge
    std::optional<Box> region;                     ///< of grids; empty: the cloud's bounding box in each frame
    std::map<std::string, std::string> options{};  ///< of formats, other than their defaults

    /// Throws InputError that names the option and its words.
    void setOption(const std::string& id, const std::string& word);
    [[nodiscard]] const std::string& option(const std::string& id) const;
    /// The options that keys and records of runs name, with their words.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> namedOptions() const;
};

}  // namespace dustbench::exports
