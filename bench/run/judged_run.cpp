#include "bench/run/judged_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/export/whole_file.h"
#include "bench/measure/image/heat_map.h"
#include "bench/run/frame_runner.h"
#include "bench/run/method_host.h"
#include "methods/contract/registry.h"

namespace dustbench::run {
namespace fs = std::filesystem;
namespace {

bool isAmong(const std::vector<std::int64_t>& frames, std::int64_t frame) {
    return std::ranges::binary_search(frames, frame);
}

results::ResolvedParameters resolvedWith(const results::RunSpec& spec, const results::ParameterTexts& finer) {
    results::ParameterTexts all = spec.parameters;
    for (const auto& [name, value] : finer) all[name] = value;
    return results::resolveParameters(findMethod(spec.method), all);
}

/// The same method at a finer setting, in its own world, stepped in parallel.
class FinerRun {
 public:
    FinerRun(const results::RunSpec& spec, gpu::Device& device)
        : parameters_(resolvedWith(spec, spec.metricPlan->finer)),
          world_(spec.scene, spec.drive, parameters_.world, spec.seed),
          runner_(spec, world_, device, parameters_.method, false) {
        world_.followPath(spec.cameraPath);
        world_.useDust(results::givenDust(spec));
        (void)placeDust(spec, world_, device);
    }

    void step(std::int64_t step, std::int64_t prerollSteps, std::int64_t warmup) {
        const std::int64_t index = step - prerollSteps - warmup;
        step + 1 < prerollSteps ? runner_.stepWithoutPicture(index) : runner_.updateOnly(index);
    }
    [[nodiscard]] reference::ExactMoment moment(bool withDetail) {
        reference::DrawnMoment drawn = runner_.drawn(withDetail);
        reference::ExactMoment exact;
        if (withDetail) exact.continuum = drawn.layer;
        exact.layer = std::move(drawn.layer);
        exact.layerWithoutScene = std::move(drawn.layerWithoutScene);
        return exact;
    }
    void volume(VolumeVisitor& visitor) { runner_.volume(visitor); }

 private:
    results::ResolvedParameters parameters_;
    world::World world_;
    FrameRunner runner_;
};

void savePictures(const reference::EvaluatedMoment& evaluated, const fs::path& folder) {
    const auto file = [&](const char* what, const char* extension) {
        return folder / fmt::format("f{:06}{}.{}", evaluated.metrics.frame, what, extension);
    };
    for (const char* extension : {"png", "exr"}) {
        pictures::writeImage(evaluated.picture, file("", extension));
        pictures::writeImage(evaluated.reference, file("_reference", extension));
    }
    pictures::writeImage(measure::heatMap(evaluated.difference), file("_difference", "png"));
}

}  // namespace

std::string whyNotEvaluated(const reference::MetricPlan& plan, const Method& method) {
    if (!method.stateHash() || !plan.finer.empty()) return {};
    return "no metrics: the method runs its own simulation, so a suite must name a finer setting of it as the "
           "reference ([metric_reference.ID])";
}

reference::RunMetrics evaluateRun(const results::RunSpec& spec, const fs::path& folder, gpu::Device& device,
                                  const std::string& stateHash, const RunProgress& progress,
                                  const fs::path& references) {
    const MethodInfo& info = findMethod(spec.method);
    const results::ResolvedParameters parameters = results::resolveParameters(info, spec.parameters);
    world::World world(spec.scene, spec.drive, parameters.world, spec.seed);
    world.followPath(spec.cameraPath);
    world.useDust(results::givenDust(spec));
    (void)placeDust(spec, world, device);
    std::optional<world::World> continuum;
    std::optional<FinerRun> finer;
    if (!spec.metricPlan->finer.empty())
        finer.emplace(spec, device);
    else if (spec.dust.empty())
        continuum.emplace(spec.scene, spec.drive, parameters.world, spec.seed, reference::continuumParticles);
    FrameRunner runner(spec, world, device, parameters.method, false);
    const std::vector<std::int64_t> moments = spec.metricPlan->momentsOf(spec.frames);
    const std::vector<std::int64_t> stretch = reference::MetricPlan::stretchOf(spec.frames);
    if (spec.metricPlan->keepsPictures) fs::create_directories(folder / "images");

    reference::ReferenceStore store(references);
    reference::RunMetrics runMetrics;
    reference::PoppingMeter poppingMeter;
    const auto evaluate = [&](std::int64_t frame) {
        const bool isMoment = isAmong(moments, frame), inStretch = isAmong(stretch, frame);
        if (!isMoment && !inStretch) return;
        const scene::View view = world.view(spec.size.width, spec.size.height);
        const reference::DrawnMoment drawn = runner.drawn(isMoment);
        reference::ExactMoment exact =
            finer ? finer->moment(isMoment)
                  : reference::exactMoment(world.scene(), view, drawn, world.unlitDust(), isMoment,
                                           isMoment && continuum ? std::optional(continuum->unlitDust()) : std::nullopt,
                                           store);
        // Dust from a file has no emitters, so it is its own continuum.
        if (isMoment && !finer && !continuum) {
            exact.continuum = exact.layer;
            exact.ofOneColour = true;
        }
        reference::MomentMetrics metrics;
        if (isMoment) {
            exports::CollectedVolume volume, reference;
            runner.volume(volume);
            finer ? finer->volume(reference) : reference.puffs(world.dust());
            reference::EvaluatedMoment evaluated = reference::evaluateMoment(
                drawn, exact, {runner.host().primitives(), volume, reference, view, spec.seed});
            evaluated.metrics.frame = frame;
            if (spec.metricPlan->keepsPictures) savePictures(evaluated, folder / "images");
            metrics = evaluated.metrics;
        }
        metrics.frame = frame;
        metrics.timeSeconds = world.state().timeSeconds;
        if (inStretch) {
            exports::CollectedVolume volume;
            runner.volume(volume);
            metrics.values.set("popping",
                               poppingMeter.add(drawn, exact, reference::sizedPrimitivesOnScreen(volume, view)));
        }
        runMetrics.frames.push_back(metrics);
    };
    const std::int64_t preroll = stepsBeforeWarmup(world);
    // Steps the continuum only to the last moment that needs it.
    const std::int64_t continuumSteps = preroll + spec.warmup + moments.back() + 1;
    std::int64_t steps = 0;
    const auto stepped = [&] {
        if (finer) finer->step(steps, preroll, spec.warmup);
        if (continuum && steps < continuumSteps) continuum->step();
        ++steps;
        return true;
    };
    const std::int64_t allSteps = preroll + spec.warmup + spec.frames;
    const auto atMetrics = [&](std::string_view, std::int64_t, std::int64_t) { progress("metrics", steps, allSteps); };
    replay({spec, runner, preroll, spec.frames - 1, stepped, evaluate, atMetrics});

    if (const std::string again = fmt::format("{:016x}", world.stateHash()); again != stateHash)
        throw std::runtime_error("metrics: the replay of the run ends in state " + again + ", not in " + stateHash);
    runMetrics.ofRun = measure::valuesOf(poppingMeter.ofRun());
    exports::writeWhole(folder / "metrics.csv", reference::metricsCsv(runMetrics));
    return runMetrics;
}

}  // namespace dustbench::run
