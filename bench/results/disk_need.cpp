#include "bench/results/disk_need.h"

#include <fmt/format.h>

#include <array>

namespace dustbench::bench {
namespace {

constexpr std::uint64_t tableBytesPerFrame = 1000;  // frames.csv and a few rows of stages.csv
constexpr std::uint64_t bytesPerPixel = 4 + 16;     // a .png and an .exr of 32-bit floats
constexpr std::uint64_t otherBytes = 1 << 20;       // run.json, log

}  // namespace

std::uint64_t maximumBytesOf(const RunSpec& spec) {
    const auto frames = static_cast<std::uint64_t>(spec.frames);
    const auto picture =
        static_cast<std::uint64_t>(spec.size.width) * static_cast<std::uint64_t>(spec.size.height) * bytesPerPixel;
    std::uint64_t bytes = otherBytes + frames * tableBytesPerFrame;
    if (spec.imagesEvery > 0) {
        const auto every = static_cast<std::uint64_t>(spec.imagesEvery);
        bytes += (frames + every - 1) / every * picture;
    }
    if (spec.metricPlan && spec.metricPlan->keepsPictures) {
        const auto moments = spec.metricPlan->momentsOf(spec.frames).size();
        bytes += moments * 3 * picture;  // the method's, the reference and the difference
    }
    if (spec.volumes) {
        const auto edge = static_cast<std::uint64_t>(spec.volumes->resolution);
        bytes += static_cast<std::uint64_t>(spec.volumes->frames.count()) * spec.volumes->formats.size() * edge * edge *
                 edge * sizeof(float);
    }
    return bytes;
}

std::uint64_t freeBytes(const std::filesystem::path& folder) {
    return std::filesystem::space(folder).available;
}

std::string bytesText(std::uint64_t bytes) {
    constexpr std::array<const char*, 5> units{"B", "kB", "MB", "GB", "TB"};
    double value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1000 && unit + 1 < units.size(); ++unit) value /= 1000;
    return fmt::format("{:.{}f} {}", value, unit == 0 || value >= 100 ? 0 : 1, units[unit]);
}

}  // namespace dustbench::bench
