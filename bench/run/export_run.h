// Exports volumes of a run without measuring it: same world and method step by step, nothing drawn or timed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/run/measured_run.h"
#include "bench/world/world.h"

namespace dustbench::run {

/// The last frame within the duration of the drive; negative if there is none.
[[nodiscard]] std::int64_t lastFrameOfDrive(const world::World& world, std::int64_t warmup);

struct ExportResult {
    std::vector<std::filesystem::path> series;
    bool gridsDiffer = false;  ///< see VolumeExporter
    bool aborted = false;      ///< `interrupted` returned true; files already written are complete
};

/// Writes the volumes requested in `spec.volumes`, and export.json, into `folder`. At each exported frame the world and
/// the method have made exactly the same steps as in `measureRun`. `interrupted` is called after every step. Throws
/// InputError for user-correctable errors, including frames beyond the drive's end, before the folder is created.
[[nodiscard]] ExportResult exportVolumes(const results::RunSpec& spec, const std::filesystem::path& folder,
                                         std::vector<std::string> argv, const RunProgress& progress,
                                         const std::function<bool()>& interrupted);

}  // namespace dustbench::run
