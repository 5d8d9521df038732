#include "bench/run/measured_run.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstdlib>

#include "bench/measure/memory_probe.h"
#include "bench/run/frame_files.h"
#include "bench/run/frame_runner.h"
#include "bench/run/results_folder.h"
#include "bench/run/summary.h"
#include "methods/shared/registry.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

std::string hexadecimal(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

void savePicture(FrameRunner& runner, const fs::path& folder, std::int64_t index) {
    fs::create_directories(folder / "images");
    const draw::Image picture = runner.picture();
    for (const char* extension : {"png", "exr"})
        draw::writeImage(picture, folder / "images" / fmt::format("f{:06}.{}", index, extension));
}

void addMemory(RunRecord& record, const std::string& owner, const MemoryReport& report) {
    for (const MemoryUse& use : report) record.memory.emplace_back(owner, use);
}

/// The untimed steps, of which the last is verified, then warm-up and recorded frames.
void runFrames(const RunSpec& spec, const World& world, FrameRunner& runner, const fs::path& folder,
               const RunProgress& progress) {
    const std::int64_t preroll = std::max<std::int64_t>(world.prerollSteps(), 1);
    for (std::int64_t step = 0; step < preroll; ++step) {
        progress("preroll", step, preroll);
        const std::int64_t index = step - preroll - spec.warmup;
        step + 1 < preroll ? runner.stepWithoutPicture(index) : runner.verifiedStep(index);
    }
    for (std::int64_t index = -spec.warmup; index < spec.frames; ++index) {
        if (index == 0) runner.drain();
        if (index < 0)
            progress("warmup", index + spec.warmup, spec.warmup);
        else
            progress("frames", index, spec.frames);
        runner.frame(index);
        if (spec.imagesEvery > 0 && index >= 0 && index % spec.imagesEvery == 0) savePicture(runner, folder, index);
    }
    runner.drain();
    progress("frames", spec.frames, spec.frames);
}

void measure(const RunSpec& spec, const fs::path& folder, const RunProgress& progress, RunRecord& record) {
    const MethodInfo& info = findMethod(spec.method);
    const ResolvedParameters parameters = resolveParameters(info, spec.parameters);
    World world(spec.scene, spec.drive, parameters.world, spec.seed);
    record.drive = world.driveId();
    record.provenance.inputs = hashInputs(world.inputFiles());
    const int threads = oneapi::tbb::this_task_arena::max_concurrency();

    if (const std::string reason = info.cannotTake ? info.cannotTake(world.scene()) : ""; !reason.empty()) {
        record.status = RunStatus::skipped;
        record.reason = reason;
        record.summary = identityColumns(record, threads);
        return;
    }

    gpu::Device device;
    record.provenance.device = device.info();
    record.provenance.gpuTimersTrusted = gpu::timerQueriesAreTrue(device);
    FrameRunner runner(spec, world, device, info.create(parameters.method), record.provenance.gpuTimersTrusted);
    runFrames(spec, world, runner, folder, progress);

    if (world.state().timeSeconds > world.driveSeconds() + 0.5 * stepSeconds)
        record.provenance.warnings.push_back(
            fmt::format("the run ends at {:.1f} s, the drive at {:.1f} s: its last row was held",
                        world.state().timeSeconds, world.driveSeconds()));

    record.stateHash = hexadecimal(world.stateHash());
    if (const auto hash = runner.method().stateHash()) record.methodHash = hexadecimal(*hash);
    addMemory(record, "world", world.memory());
    addMemory(record, "method", runner.method().memory());
    for (const auto& [structure, bytes] : device.ledger().entries())
        record.memory.emplace_back("device", MemoryUse{structure, 0, bytes});

    record.summary = identityColumns(record, threads);
    for (auto& column : measuredColumns(runner.records(), peakResidentBytes()))
        record.summary.push_back(std::move(column));
    if (const auto kept = runner.massKept()) record.summary.emplace_back("mass_kept", *kept);
    if (spec.imagesEvery > 0) record.summary.emplace_back("FILE_image", "runs/" + runId(spec) + "/images/f000000.png");
    writeWhole(folder / "frames.csv", framesCsv(runner.records()));
    writeWhole(folder / "stages.csv", stagesCsv(runner.records()));
}

}  // namespace

RunRecord measureRun(const RunSpec& spec, const fs::path& folder, std::vector<std::string> argv,
                     const RunProgress& progress) {
    RunRecord record;
    record.spec = spec;
    record.drive = spec.drive;
    record.provenance = startProvenance(std::move(argv));
    if (spec.threads == 0) {
        measure(spec, folder, progress, record);
        return record;
    }
    // A software rasteriser counts as well: the run shall use so many threads, not so many and some more.
    setenv("LP_NUM_THREADS", std::to_string(spec.threads).c_str(), 0);
    const auto threads = static_cast<std::size_t>(spec.threads);
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    oneapi::tbb::task_arena arena(spec.threads);
    arena.execute([&] { measure(spec, folder, progress, record); });
    return record;
}

}  // namespace dustbench::bench
