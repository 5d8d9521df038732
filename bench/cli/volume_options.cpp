#include "bench/cli/volume_options.h"

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
    arguments.text("--format", "NAME,NAME…",
                   "formats of volumes: vti (grid), htg (octree), vtp (particles), vdb (OpenVDB); default: vti",
                   formats_);
    arguments.text("--resolution", "N", "voxels along the longest edge of a grid, at most 2048; default: 128",
                   resolution_);
    arguments.text("--region", "x0,y0,z0,x1,y1,z1",
                   "box that the grids cover, in metres; default: the extent of each frame's cloud", region_);
    arguments.text("--vdb-precision", "half|float", "precision of .vdb; default: half", precision_);
}

std::optional<bench::VolumeSettings> VolumeOptions::over(const std::optional<bench::VolumeSettings>& base) const {
    if (!base && frames_.empty()) {
        for (const auto& [name, given] : {std::pair("--format", !formats_.empty()),
                                          {"--resolution", !resolution_.empty()},
                                          {"--region", !region_.empty()},
                                          {"--vdb-precision", !precision_.empty()}})
            if (given)
                throw InputError(std::string(name) + ": given without " + framesName_ + ", which selects the frames");
        return std::nullopt;
    }
    bench::VolumeSettings settings = base.value_or(bench::VolumeSettings());
    if (!frames_.empty()) settings.frames = bench::parseFrameRange(framesName_, frames_);
    if (!formats_.empty()) settings.formats = bench::parseFormats(formats_);
    if (!resolution_.empty()) settings.resolution = bench::parseResolution(resolution_);
    if (!region_.empty()) settings.region = bench::parseRegion(region_);
    if (!precision_.empty()) settings.vdbPrecision = bench::vdbPrecisions.parse("vdb precision", precision_);
    return settings;
}

}  // namespace dustbench::cli
