#include "bench/run/export_run.h"

#include <fmt/format.h>

#include <cmath>

#include "bench/export/volume_exporter.h"
#include "bench/export/whole_file.h"
#include "bench/results/input_files.h"
#include "bench/results/run_record.h"
#include "bench/run/frame_runner.h"
#include "bench/run/measured_run.h"
#include "bench/run/method_host.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::run {
namespace fs = std::filesystem;
namespace {

void requireFramesWithinDrive(const results::RunSpec& spec, const world::World& world) {
    const std::int64_t last = lastFrameOfDrive(world, spec.warmup);
    if (spec.volumes->frames.last <= last) return;
    const std::string allowed =
        last < 0 ? "none, because the warm-up is longer than the drive" : fmt::format("frames 0..{}", last);
    throw InputError(fmt::format("frames: frame {} is beyond the end of drive '{}' ({} s), allowed: {}",
                                 spec.volumes->frames.last, world.driveId(), world.driveSeconds(), allowed));
}

ExportResult exportFrames(const results::RunSpec& spec, const fs::path& folder, const RunProgress& progress,
                          const std::function<bool()>& interrupted, results::ExportRecord& record) {
    const files::InputLog read;
    const MethodInfo& info = findMethod(spec.method);
    const results::ResolvedParameters parameters = results::resolveParameters(info, spec.parameters);
    world::World world(spec.scene, spec.drive, parameters.world, spec.seed);
    world.followPath(spec.cameraPath);
    world.useDust(results::givenDust(spec));
    requireFramesWithinDrive(spec, world);
    if (const std::string reason = whyNotTaken(info, world.scene()); !reason.empty())
        throw InputError(fmt::format("method {} cannot show scene '{}': {}", spec.method, spec.scene, reason));
    record.drive = world.driveId();

    exports::VolumeExporter exporter(*spec.volumes, folder);
    gpu::Device device;
    record.provenance.device = device.info();
    record.provenance.dustOn = placeDust(spec, world, device);
    FrameRunner runner(spec, world, device, parameters.method, false);
    results::recordInputs(world, parameters.method, read, record.provenance);

    ExportResult result;
    const exports::FrameRange& frames = spec.volumes->frames;
    const std::vector<std::string> configuration = results::configurationOf(spec);
    const auto write = [&](std::int64_t index) {
        if (!frames.contains(index)) return;
        exports::CollectedVolume volume;
        runner.volume(volume);
        exporter.write({index, spec.method, volume, world.scene(), world.state(), world.dust(), configuration});
        record.moments.push_back({index, world.state().timeSeconds, fmt::format("{:016x}", world.stateHash())});
    };
    result.aborted =
        !replay({spec, runner, stepsBeforeWarmup(world), frames.last, [&] { return !interrupted(); }, write, progress});
    result.series = exporter.seriesFiles();
    result.gridsDiffer = exporter.gridsDiffer();
    if (result.aborted) return result;
    for (const fs::path& series : result.series) record.series.push_back(series.filename());
    exports::writeWhole(folder / "export.json", results::toJson(record));
    return result;
}

}  // namespace

std::int64_t lastFrameOfDrive(const world::World& world, std::int64_t warmup) {
    // Steps end at integer multiples of their length. The preroll ends at time 0, or one step later if it is shorter
    // than a step.
    const std::int64_t stepsOfDrive = std::llround(world.driveSeconds() / world::stepSeconds);
    return stepsOfDrive - 1 - warmup - (stepsBeforeWarmup(world) - world.prerollSteps());
}

ExportResult exportVolumes(const results::RunSpec& spec, const fs::path& folder, std::vector<std::string> argv,
                           const RunProgress& progress, const std::function<bool()>& interrupted) {
    results::ExportRecord record;
    record.spec = spec;
    record.provenance = measure::startProvenance(std::move(argv));
    ExportResult result;
    withThreads(spec.threads, [&] { result = exportFrames(spec, folder, progress, interrupted, record); });
    return result;
}

}  // namespace dustbench::run
