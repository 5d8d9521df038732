// Volumes of a run without its measurement: the same world and method step by step, nothing drawn, nothing timed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/run/measured_run.h"
#include "bench/scene/world.h"

namespace dustbench::bench {

/// The last frame whose time lies within the drive; below 0: there is none.
[[nodiscard]] std::int64_t lastFrameOfDrive(const World& world, std::int64_t warmup);

struct ExportResult {
    std::vector<std::filesystem::path> series;
    bool gridsDiffer = false;  ///< see VolumeExporter
    bool aborted = false;      ///< `interrupted` said so; what was written is whole
};

/// Writes what `spec.volumes` asks for, and export.json, into `folder`. At each of its frames the world and the method
/// have gone through the very steps that they would have in `measureRun`. `interrupted` is asked after every step.
/// Throws InputError for what a person can mend, frames beyond the drive's end among it, before the folder is made.
[[nodiscard]] ExportResult exportVolumes(const RunSpec& spec, const std::filesystem::path& folder,
                                         std::vector<std::string> argv, const RunProgress& progress,
                                         const std::function<bool()>& interrupted);

}  // namespace dustbench::bench
