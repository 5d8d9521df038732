#include "bench/reference/judge/judgement.h"

#include <fmt/format.h>

#include "bench/export/extinction_grid.h"
#include "bench/measure/image/picture.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/volume_error.h"
#include "bench/reference/judge/reported_depths.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

/// The pixels are opaque up to rounding; the metrics require exactly 1.
pictures::Image overScene(const pictures::Image& layer, const pictures::Image& scene) {
    pictures::Image image = pictures::over(layer, scene);
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

/// Prepares what the metrics need of the two pictures.
EvaluatedMoment prepare(const DrawnMoment& drawn, const ExactMoment& exact, ComparedMoment& moment) {
    EvaluatedMoment evaluated{{}, overScene(drawn.layer, drawn.scene), overScene(exact.layer, drawn.scene), {}};
    moment.picture = preparePicture(evaluated.picture, "the method's picture");
    moment.reference = preparePicture(evaluated.reference, "the reference");
    moment.alpha = alphaOf(drawn.layer, "the method's layer");
    moment.referenceAlpha = alphaOf(exact.layer, "the reference's layer");
    moment.mask = dustMask(moment.alpha, moment.referenceAlpha);
    moment.flip = flip(moment.reference, moment.picture);
    return evaluated;
}

void evaluate(ComparedMoment& moment, EvaluatedMoment& evaluated) {
    evaluated.metrics.values = valuesOf(moment);
    evaluated.difference = std::move(moment.flip.map);
}

std::optional<double> valueOfRun(const RunMetrics& runMetrics, const Metric& metric) {
    if (metric.overRun == OverRun::pairs || metric.overRun == OverRun::whole) return runMetrics.ofRun.of(metric.column);
    double sum = 0;
    int count = 0;
    for (const MomentMetrics& moment : runMetrics.frames)
        if (const std::optional<double>& value = moment.values.of(metric.column)) {
            sum += *value;
            ++count;
        }
    if (count == 0) return std::nullopt;
    if (metric.overRun == OverRun::all) return sum == count ? 1 : 0;
    return sum / count;
}

}  // namespace

EvaluatedMoment comparePictures(const DrawnMoment& drawn, const ExactMoment& exact) {
    ComparedMoment moment;
    EvaluatedMoment evaluated = prepare(drawn, exact, moment);
    evaluate(moment, evaluated);
    return evaluated;
}

EvaluatedMoment evaluateMoment(const DrawnMoment& drawn, const ExactMoment& exact, const MomentFacts& facts) {
    ComparedMoment moment;
    EvaluatedMoment evaluated = prepare(drawn, exact, moment);
    moment.alphaFree = alphaOf(drawn.layerWithoutScene, "the method's layer without the scene");
    moment.referenceAlphaFree = alphaOf(exact.layerWithoutScene, "the reference's layer without the scene");
    moment.continuum = alphaOf(exact.continuum, "the continuum's layer");
    if (exact.ofOneColour)
        moment.continuumPicture = preparePicture(overScene(exact.continuum, drawn.scene), "the continuum");
    moment.primitives = facts.primitives;
    moment.onScreen = primitivesOnScreen(facts.volume, facts.view);
    moment.seed = facts.seed;
    ExtinctionGrid grid, referenceGrid;
    if (!facts.volume.isNothing() && !facts.referenceVolume.isNothing()) {
        const GridPlan plan = planGrid(facts.referenceVolume.bounds(), VolumeSettings().resolution);
        referenceGrid = computeGrid(facts.referenceVolume, plan);
        grid = computeGrid(facts.volume, plan);
        moment.referenceGrid = GridCells{plan.cells, referenceGrid.extinctionPerMetre};
        moment.grid = GridCells{plan.cells, grid.extinctionPerMetre};
    }
    if (!facts.volume.isNothing())
        moment.volumeAlpha = reportedAlpha(facts.volume, facts.view, distancesFromDepth(facts.view, drawn.sceneDepth));
    evaluate(moment, evaluated);
    return evaluated;
}

std::optional<double> PoppingMeter::add(const DrawnMoment& drawn, const ExactMoment& exact,
                                        std::span<const SizedPrimitive> primitives) {
    Kept now{preparePicture(overScene(drawn.layer, drawn.scene), "the method's picture"),
             preparePicture(overScene(exact.layer, drawn.scene), "the reference"),
             alphaOf(drawn.layer, "the method's layer"), alphaOf(exact.layer, "the reference's layer"),
             largeAmong(primitives, drawn.layer.width, drawn.layer.height)};
    std::optional<double> value;
    if (before_) {
        const DustFrame then{before_->image, before_->reference, before_->alpha, before_->referenceAlpha};
        const DustFrame here{now.image, now.reference, now.alpha, now.referenceAlpha};
        value = popping(then, here).value;
        summary_.add(value);
        if (value && before_->depths && now.depths) {
            const PoppingBySize bySize = poppingBySize(then, here, *before_->depths, *now.depths);
            small_.add(bySize.small);
            large_.add(bySize.large);
            smallPart_.add(bySize.smallPart.value_or(0));
            largePart_.add(bySize.largePart.value_or(0));
        }
    }
    before_ = std::move(now);
    return value;
}

void PoppingMeter::Mean::add(const std::optional<double>& value) {
    if (!value) return;
    sum += *value;
    ++count;
}

std::optional<double> PoppingMeter::Mean::value() const {
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

PoppingOfRun PoppingMeter::ofRun() const {
    if (!summary_.mean()) return {summary_, {}};
    return {summary_, {small_.value(), large_.value(), smallPart_.value(), largePart_.value()}};
}

std::string metricsCsv(const RunMetrics& runMetrics) {
    const auto hasFrames = [](const Metric& metric) { return metric.overRun != OverRun::whole; };
    std::string text = "frame,time_s";
    for (const Metric& metric : metrics())
        if (hasFrames(metric)) text.append(",").append(metric.column);
    text += "\n";
    for (const MomentMetrics& moment : runMetrics.frames) {
        text += std::to_string(moment.frame) + "," + files::csvNumber(moment.timeSeconds);
        for (const Metric& metric : metrics()) {
            if (!hasFrames(metric)) continue;
            const std::optional<double>& value = moment.values.of(metric.column);
            text += "," + (value ? files::csvNumber(*value) : "");
        }
        text += "\n";
    }
    return text;
}

std::vector<std::pair<std::string, double>> summaryOf(const RunMetrics& runMetrics) {
    std::vector<std::pair<std::string, double>> cells;
    for (const Metric& metric : metrics())
        if (const std::optional<double> value = valueOfRun(runMetrics, metric))
            cells.emplace_back(metric.column, *value);
    return cells;
}

std::string volumeWarning(const RunMetrics& runMetrics) {
    for (const auto& [column, value] : summaryOf(runMetrics))
        if (column == "volume_picture" && value > maximumVolumePicture)
            return fmt::format(
                "the method does not draw the volume that it reports: volume_picture is {:.2f}, allowed: up to {}; "
                "volume_error describes that volume, not the picture",
                value, maximumVolumePicture);
    return {};
}

}  // namespace dustbench::bench
