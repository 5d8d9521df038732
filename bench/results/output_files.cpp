#include "bench/results/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/measure/sha256.h"
#include "methods/kit/files/limits.h"

namespace dustbench::results {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 3> notOutputs{"run.json", "spec.json", "log.txt"};

std::string sumOf(const fs::path& file, std::uintmax_t bytes) {
    return bytes > files::limits::summedBytes ? "" : measure::sha256OfFile(file, files::limits::summedBytes);
}

std::string whyOtherLength(const OutputFile& output, const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(file, error);
    if (status.type() == fs::file_type::not_found) return fmt::format("{} is missing", output.file);
    if (status.type() == fs::file_type::symlink) return fmt::format("{} is a symbolic link", output.file);
    if (status.type() != fs::file_type::regular) return fmt::format("{} is not a regular file", output.file);
    const std::uintmax_t bytes = fs::file_size(file, error);
    if (error) return fmt::format("{} cannot be read: {}", output.file, error.message());
    return bytes == output.bytes ? "" : fmt::format("{} has {} bytes, expected {}", output.file, bytes, output.bytes);
}

constexpr std::uint64_t tableBytesPerFrame = 1000;  // frames.csv and a few rows of stages.csv
constexpr std::uint64_t bytesPerPixel = 4 + 16;     // a .png and an .exr of 32-bit floats
constexpr std::uint64_t otherBytes = 1 << 20;       // run.json, log

}  // namespace

std::vector<OutputFile> outputsIn(const fs::path& runFolder) {
    std::vector<OutputFile> outputs;
    for (const auto& entry : fs::recursive_directory_iterator(runFolder)) {
        const std::string name = entry.path().lexically_relative(runFolder).generic_string();
        if (!entry.is_regular_file() || std::ranges::find(notOutputs, name) != notOutputs.end()) continue;
        outputs.push_back({name, entry.file_size(), sumOf(entry.path(), entry.file_size())});
    }
    std::ranges::sort(outputs, {}, &OutputFile::file);
    return outputs;
}

std::string whyAltered(std::span<const OutputFile> outputs, const fs::path& runFolder) {
    for (const OutputFile& output : outputs)
        if (std::string why = whyOtherLength(output, runFolder / output.file); !why.empty()) return why;
    for (const OutputFile& output : outputs)
        if (!output.sha256.empty() && sumOf(runFolder / output.file, output.bytes) != output.sha256)
            return fmt::format("{} was altered: its SHA-256 differs", output.file);
    return "";
}

bool isWithin(const fs::path& name) {
    return !name.empty() && name.is_relative() && name.lexically_normal().native() == name.native() &&
           *name.begin() != ".." && *name.begin() != ".";
}

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

std::uint64_t freeBytes(const fs::path& folder) {
    return fs::space(folder).available;
}

std::string bytesText(std::uint64_t bytes) {
    constexpr std::array<const char*, 5> units{"B", "kB", "MB", "GB", "TB"};
    double value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1000 && unit + 1 < units.size(); ++unit) value /= 1000;
    return fmt::format("{:.{}f} {}", value, unit == 0 || value >= 100 ? 0 : 1, units[unit]);
}

}  // namespace dustbench::results
