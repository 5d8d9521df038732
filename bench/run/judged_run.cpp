#include "bench/run/judged_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/export/whole_file.h"
#include "bench/measure/image/heat_map.h"
#include "bench/run/replay.h"
#include "methods/shared/registry.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

bool isAmong(const std::vector<std::int64_t>& frames, std::int64_t frame) {
    return std::ranges::binary_search(frames, frame);
}

void savePictures(const JudgedMoment& judged, const fs::path& folder) {
    const auto file = [&](const char* what, const char* extension) {
        return folder / fmt::format("f{:06}{}.{}", judged.metrics.frame, what, extension);
    };
    for (const char* extension : {"png", "exr"}) {
        draw::writeImage(judged.picture, file("", extension));
        draw::writeImage(judged.reference, file("_reference", extension));
    }
    draw::writeImage(heatMap(judged.difference), file("_difference", "png"));
}

}  // namespace

Judgement judgeRun(const RunSpec& spec, const fs::path& folder, gpu::Device& device, const std::string& stateHash,
                   const RunProgress& progress) {
    const MethodInfo& info = findMethod(spec.method);
    const ResolvedParameters parameters = resolveParameters(info, spec.parameters);
    World world(spec.scene, spec.drive, parameters.world, spec.seed);
    World continuum(spec.scene, spec.drive, parameters.world, spec.seed, continuumParticles);
    FrameRunner runner(spec, world, device, info.create(parameters.method), false);
    const std::vector<std::int64_t> moments = spec.judging->momentsOf(spec.frames);
    const std::vector<std::int64_t> stretch = JudgingPlan::stretchOf(spec.frames);
    fs::create_directories(folder / "images");

    Judgement judgement;
    PoppingJudge poppingJudge;
    const auto judge = [&](std::int64_t frame) {
        const bool isMoment = isAmong(moments, frame), inStretch = isAmong(stretch, frame);
        if (!isMoment && !inStretch) return;
        const scene::View view = world.view(spec.size.width, spec.size.height);
        const DrawnMoment drawn = runner.drawn(isMoment);
        const ExactMoment exact =
            exactMoment(view, drawn, world.dust(), isMoment, isMoment ? &continuum.dust() : nullptr);
        MomentMetrics metrics;
        if (isMoment) {
            CollectedVolume volume;
            runner.volume(volume);
            JudgedMoment judged =
                judgeMoment(drawn, exact, {runner.method().primitives(), volume, world.dust(), view, spec.seed});
            judged.metrics.frame = frame;
            savePictures(judged, folder / "images");
            metrics = judged.metrics;
        }
        metrics.frame = frame;
        metrics.timeSeconds = world.state().timeSeconds;
        if (inStretch) metrics.popping = poppingJudge.add(drawn, exact);
        judgement.frames.push_back(metrics);
    };
    // The continuum goes along up to the last moment that needs it.
    const auto total = stepsBeforeWarmup(world) + spec.warmup + moments.back() + 1;
    std::int64_t steps = 0;
    const auto stepped = [&] {
        if (steps++ < total) {
            continuum.readInput();
            continuum.simulate();
        }
        return true;
    };
    const auto judging = [&](std::string_view, std::int64_t done, std::int64_t of) { progress("metrics", done, of); };
    replay({spec, runner, stepsBeforeWarmup(world), spec.frames - 1, stepped, judge, judging});

    if (const std::string again = fmt::format("{:016x}", world.stateHash()); again != stateHash)
        throw std::runtime_error("metrics: the run's states gone through again end in " + again + ", not in " +
                                 stateHash);
    judgement.popping = poppingJudge.summary().mean();
    judgement.poppingMax = poppingJudge.summary().maximum();
    writeWhole(folder / "metrics.csv", metricsCsv(judgement));
    return judgement;
}

}  // namespace dustbench::bench
