#include "bench/cli/volume_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/export/exporter.h"
#include "methods/contract/errors.h"

namespace dustbench::cli {

void VolumeOptions::declareRequired(Arguments& arguments) {
    arguments.required(framesName_, "A:B:STEP", "every STEP-th frame from A to B, excluding B; also A:B, or A alone",
                       frames_);
    declareRest(arguments);
}

void VolumeOptions::declareOptional(Arguments& arguments) {
    arguments.text(framesName_, "A:B:STEP", "write volumes of every STEP-th frame from A to B, excluding B", frames_);
    declareRest(arguments);
}

void VolumeOptions::declareRest(Arguments& arguments) {
    std::string formats;
    for (const bench::Exporter& exporter : bench::exporters())
        formats += fmt::format("{}{} ({})", formats.empty() ? "" : ", ", exporter.id, exporter.kind);
    arguments.text("--format", "NAME,NAME…", "formats of volumes: " + formats + "; default: vti", formats_);
    arguments.text("--resolution", "N", "voxels along the longest edge of a grid, at most 2048; default: 128",
                   resolution_);
    arguments.text("--region", "x0,y0,z0,x1,y1,z1",
                   "box that the grids cover, in metres; default: the extent of each frame's cloud", region_);
    for (const bench::ExporterOption& option : bench::exporterOptions())
        arguments.text(option.commandName(), fmt::format("{}", fmt::join(option.words, "|")), option.help,
                       options_[option.id]);
}

std::optional<bench::VolumeSettings> VolumeOptions::over(const std::optional<bench::VolumeSettings>& base) const {
    if (!base && frames_.empty()) {
        std::vector<std::pair<std::string, bool>> all{
            {"--format", !formats_.empty()}, {"--resolution", !resolution_.empty()}, {"--region", !region_.empty()}};
        for (const bench::ExporterOption& option : bench::exporterOptions())
            all.emplace_back(option.commandName(), !options_.at(option.id).empty());
        for (const auto& [name, given] : all)
            if (given) throw InputError(name + ": given without " + framesName_ + ", which selects the frames");
        return std::nullopt;
    }
    bench::VolumeSettings settings = base.value_or(bench::VolumeSettings());
    if (!frames_.empty()) settings.frames = bench::parseFrameRange(framesName_, frames_);
    if (!formats_.empty()) settings.formats = bench::parseFormats(formats_);
    if (!resolution_.empty()) settings.resolution = bench::parseResolution(resolution_);
    if (!region_.empty()) settings.region = bench::parseRegion(region_);
    for (const auto& [id, word] : options_)
        if (!word.empty()) settings.setOption(id, word);
    return settings;
}

}  // namespace dustbench::cli
