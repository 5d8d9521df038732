#include "bench/run/measured_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstdlib>
#include <string>

#include "bench/export/volume_exporter.h"
#include "bench/measure/clock.h"
#include "bench/measure/clock_watch.h"
#include "bench/measure/energy.h"
#include "bench/measure/memory_probe.h"
#include "bench/measure/statistics.h"
#include "bench/measure/steadiness.h"
#include "bench/results/compared_runs.h"
#include "bench/results/input_files.h"
#include "bench/results/method_facts.h"
#include "bench/results/results_folder.h"
#include "bench/results/summary.h"
#include "bench/run/frame_runner.h"
#include "bench/run/judged_run.h"
#include "bench/run/method_host.h"
#include "methods/contract/registry.h"

namespace dustbench::run {

namespace fs = std::filesystem;
namespace {

std::string hexadecimal(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

void savePicture(FrameRunner& runner, const fs::path& folder, std::int64_t index) {
    fs::create_directories(folder / "images");
    const pictures::Image picture = runner.picture();
    for (const char* extension : {"png", "exr"})
        pictures::writeImage(picture, folder / "images" / fmt::format("f{:06}.{}", index, extension));
}

void addMemory(results::RunRecord& record, const std::string& owner, const MemoryReport& report) {
    for (const MemoryUse& use : report) record.memory.emplace_back(owner, use);
}

/// The volumes of a run, written between frames.
class RunVolumes {
 public:
    RunVolumes(const results::RunSpec& spec, const fs::path& folder, const world::World& world,
               std::vector<std::string>& warnings)
        : spec_(spec), configuration_(results::configurationOf(spec)), world_(world), warnings_(warnings) {
        if (spec.volumes) exporter_.emplace(*spec.volumes, folder / "volumes");
    }

    [[nodiscard]] bool wants(std::int64_t index) const {
        return exporter_ && exporter_->settings().frames.contains(index);
    }
    /// After frame `index`.
    void write(FrameRunner& runner, std::int64_t index) {
        runner.drain();
        exports::CollectedVolume volume;
        runner.volume(volume);
        if (index == exporter_->settings().frames.first) leaveOutImpossible(volume);
        exporter_->write({index, spec_.method, volume, world_.scene(), world_.state(), world_.dust(), configuration_});
    }
    /// Columns of summary.csv; empty if no volume was requested.
    [[nodiscard]] std::string firstSeries() const {
        if (!exporter_ || exporter_->seriesFiles().empty()) return {};
        return "runs/" + results::runId(spec_) + "/volumes/" + exporter_->seriesFiles().front().filename().string();
    }

 private:
    /// A suite requests the same formats from all methods, so an unsupported one is an error only if none remain.
    void leaveOutImpossible(const exports::CollectedVolume& volume) {
        const std::vector<std::string> asked = exporter_->settings().formats;
        std::vector<std::string> reasons;
        for (const std::string& format : asked)
            if (const std::string reason = exports::whyNotWritable(volume, format); !reason.empty()) {
                reasons.push_back(fmt::format("no .{} was written: method {} {}", exports::exporterOf(format).extension,
                                              spec_.method, reason));
                exporter_->leaveOut(format);
            }
        if (exporter_->settings().formats.empty()) exports::requireWritable(volume, asked, spec_.method);
        warnings_.insert(warnings_.end(), reasons.begin(), reasons.end());
    }

    const results::RunSpec& spec_;
    std::vector<std::string> configuration_;
    const world::World& world_;
    std::vector<std::string>& warnings_;
    std::optional<exports::VolumeExporter> exporter_;
};

results::DustCount dustCount(const results::RunSpec& spec, const FrameRunner& runner) {
    std::vector<double> counts;
    for (const measure::FrameRecord& frame : runner.records()) counts.push_back(static_cast<double>(frame.particles));
    const bool isShown = spec.method != results::baselineMethod && !runner.method().stateHash();
    return {std::stoll(spec.parameters.at("particles")), measure::median(counts), isShown};
}

/// Moments of a run that can have no metrics: their pictures are stored anyway, for inspection.
std::vector<std::int64_t> momentsToShow(const results::RunSpec& spec, const Method& method) {
    if (!spec.metricPlan || !spec.metricPlan->keepsPictures || whyNotEvaluated(*spec.metricPlan, method).empty())
        return {};
    return spec.metricPlan->momentsOf(spec.frames);
}

/// Runs the untimed steps, the last of which is verified, then warm-up and recorded frames. Fills in the measurements
/// of the run as a whole.
void runFrames(const results::RunSpec& spec, const world::World& world, FrameRunner& runner, const fs::path& folder,
               RunVolumes& volumes, measure::EnergyMeter& energy, measure::ClockWatch& clock,
               const RunProgress& progress, results::WholeRun& run) {
    const std::int64_t preroll = stepsBeforeWarmup(world);
    for (std::int64_t step = 0; step < preroll; ++step) {
        progress("preroll", step, preroll);
        const std::int64_t index = step - preroll - spec.warmup;
        step + 1 < preroll ? runner.stepWithoutPicture(index) : runner.verifiedStep(index);
    }
    run.startSeconds = measure::secondsSinceProcessStart();
    const std::vector<std::int64_t> shown = momentsToShow(spec, runner.method());
    for (std::int64_t index = -spec.warmup; index < spec.frames; ++index) {
        if (index == 0) {
            runner.drain();
            energy.resume();
        }
        if (index < 0)
            progress("warmup", index + spec.warmup, spec.warmup);
        else
            progress("frames", index, spec.frames);
        // With frames in flight there is no time between them: the next one has begun.
        if (index >= 0 && spec.sync != results::Sync::none) clock.betweenFrames();
        runner.frame(index);
        const bool savesPicture = (spec.imagesEvery > 0 && index >= 0 && index % spec.imagesEvery == 0) ||
                                  std::ranges::binary_search(shown, index);
        if (!savesPicture && !volumes.wants(index)) continue;
        runner.drain();
        energy.pause();
        if (savesPicture) savePicture(runner, folder, index);
        if (volumes.wants(index)) volumes.write(runner, index);
        energy.resume();
    }
    runner.drain();
    clock.end();
    energy.pause();
    run.cpuJoules = energy.cpuJoules();
    run.gpuJoules = energy.gpuJoules();
    progress("frames", spec.frames, spec.frames);
}

void warnOfClock(const measure::ClockWatch& clock, std::int64_t throttledBefore, std::vector<std::string>& warnings) {
    for (std::string warning :
         {clock.warning(), measure::throttlingWarning(throttledBefore, measure::readMachine().throttled)})
        if (!warning.empty()) warnings.push_back(std::move(warning));
}

void measure(const results::RunSpec& spec, const fs::path& folder, const RunProgress& progress,
             const fs::path& references, results::RunRecord& record) {
    const files::InputLog read;
    const MethodInfo& info = findMethod(spec.method);
    const results::ResolvedParameters parameters = results::resolveParameters(info, spec.parameters);
    world::World world(spec.scene, spec.drive, parameters.world, spec.seed);
    world.followPath(spec.cameraPath);
    world.useDust(results::givenDust(spec));
    record.drive = world.driveId();
    results::recordInputs(world, parameters.method, read, record.provenance);
    const int threads = oneapi::tbb::this_task_arena::max_concurrency();

    if (const std::string reason = whyNotTaken(info, world.scene()); !reason.empty()) {
        record.status = results::RunStatus::skipped;
        record.reason = reason;
        record.summary = results::identityColumns(record, threads);
        return;
    }

    gpu::Device device;
    const auto freeAtStart = device.driverFreeBytes();
    record.provenance.device = device.info();
    record.provenance.dustOn = placeDust(spec, world, device);
    if (std::string warning = readBackWarning(world, info, parameters.method); !warning.empty())
        record.provenance.warnings.push_back(std::move(warning));
    results::WholeRun whole;
    whole.softwareRenderer = device.isSoftware();
    // Without a GPU there are no GPU times, and the self-test would compile a shader for nothing.
    record.provenance.gpuTimersTrusted = !whole.softwareRenderer && gpu::timerQueriesAreTrue(device);
    std::optional<FrameRunner> timed;
    FrameRunner& runner = timed.emplace(spec, world, device, parameters.method, record.provenance.gpuTimersTrusted);
    results::recordInputs(world, parameters.method, read, record.provenance);  // includes the method's files
    RunVolumes volumes(spec, folder, world, record.provenance.warnings);
    measure::EnergyMeter energy(measure::packageEnergy(), measure::gpuEnergy(device.info().renderer));
    measure::ClockWatch clock(spec.timed ? measure::gpuClock(device.info().renderer) : nullptr);
    const std::int64_t throttledBefore = spec.timed ? measure::readMachine().throttled : 0;
    runFrames(spec, world, runner, folder, volumes, energy, clock, progress, whole);
    if (spec.timed) warnOfClock(clock, throttledBefore, record.provenance.warnings);
    if (const auto range = clock.range()) whole.gpuMegahertz = {range->lowest, range->highest};
    whole.peakResidentBytes = measure::peakResidentBytes();
    if (const auto freeAtEnd = device.driverFreeBytes(); freeAtStart && freeAtEnd)
        whole.driverBytes = *freeAtStart - *freeAtEnd;
    runner.requireFinitePicture();

    if (world.state().timeSeconds > world.driveSeconds() + 0.5 * world::stepSeconds)
        record.provenance.warnings.push_back(
            fmt::format("the run ends at {:.1f} s, the drive at {:.1f} s: its last row applies to the rest",
                        world.state().timeSeconds, world.driveSeconds()));

    std::vector<double> frameMs;
    for (const measure::FrameRecord& frame : runner.records()) frameMs.push_back(frame.frameMs);
    if (spec.timed)
        for (std::string& warning : measure::steadinessWarnings(frameMs))
            record.provenance.warnings.push_back(std::move(warning));

    record.stateHash = hexadecimal(world.stateHash());
    if (const auto hash = runner.method().stateHash()) record.methodHash = hexadecimal(*hash);
    addMemory(record, "world", world.memory());
    addMemory(record, "method", runner.method().memory());
    for (const auto& [structure, bytes] : runner.host().gpuLedger().entries())
        record.memory.emplace_back("device", MemoryUse{structure, 0, bytes});

    record.summary = results::identityColumns(record, threads);
    for (auto& column : results::measuredColumns(runner.records(), whole))
        if (spec.timed || !results::dependsOnSpeed(column.first)) record.summary.push_back(std::move(column));
    const results::Columns facts = runner.facts();
    record.summary.insert(record.summary.end(), facts.begin(), facts.end());
    record.validity = results::whyInvalid(info, facts, dustCount(spec, runner));
    if (!record.validity.empty())
        record.summary.emplace_back("invalid", fmt::format("{}", fmt::join(record.validity, "; ")));
    if (spec.imagesEvery > 0 || (spec.metricPlan && spec.metricPlan->keepsPictures)) {
        const std::int64_t first = spec.imagesEvery > 0 ? 0 : spec.metricPlan->momentsOf(spec.frames).front();
        record.summary.emplace_back("FILE_image",
                                    fmt::format("runs/{}/images/f{:06}.png", results::runId(spec), first));
    }
    if (const std::string series = volumes.firstSeries(); !series.empty())
        record.summary.emplace_back("FILE_volume", series);
    if (spec.timed) {
        exports::writeWhole(folder / "frames.csv", results::framesCsv(runner.records()));
        exports::writeWhole(folder / "stages.csv", results::stagesCsv(runner.records()));
    }
    for (const KeptFile& file : runner.method().files()) exports::writeWhole(folder / file.name, file.text);
    if (!spec.metricPlan) return;
    if (std::string reason = whyNotEvaluated(*spec.metricPlan, runner.method()); !reason.empty()) {
        record.provenance.warnings.push_back(std::move(reason));
        return;
    }
    record.summary.emplace_back("metric_reference", spec.metricPlan->referenceText());
    timed.reset();
    const reference::RunMetrics runMetrics = evaluateRun(spec, folder, device, record.stateHash, progress, references);
    for (auto& [column, value] : reference::summaryOf(runMetrics))
        record.summary.emplace_back(std::move(column), value);
    if (std::string warning = reference::volumeWarning(runMetrics); !warning.empty())
        record.provenance.warnings.push_back(std::move(warning));
}

}  // namespace

results::RunRecord measureRun(const results::RunSpec& spec, const fs::path& folder, std::vector<std::string> argv,
                              const RunProgress& progress, const fs::path& references) {
    results::RunRecord record;
    record.spec = spec;
    record.drive = spec.drive;
    record.provenance = measure::startProvenance(std::move(argv), spec.timed);
    withThreads(spec.threads, [&] { measure(spec, folder, progress, references, record); });
    if (spec.timed && record.status == results::RunStatus::done)
        record.summary.emplace_back("run_s", measure::secondsSinceProcessStart());
    record.outputs = results::outputsIn(folder);
    return record;
}

void withThreads(int threads, const std::function<void()>& work) {
    if (threads == 0) {
        work();
        return;
    }
    // The limit includes the software rasteriser's threads, whatever the caller's environment says.
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    arena.execute(work);
}

}  // namespace dustbench::run
