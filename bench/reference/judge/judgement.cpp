#include "bench/reference/judge/judgement.h"

#include <fmt/format.h>

#include "bench/export/extinction_grid.h"
#include "bench/measure/image/picture.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/volume_error.h"
#include "bench/reference/judge/reported_depths.h"
#include "methods/kit/files/csv.h"

namespace dustbench::reference {
namespace {

/// The pixels are opaque up to rounding; the metrics require exactly 1.
pictures::Image overScene(const pictures::Image& layer, const pictures::Image& scene) {
    pictures::Image image = pictures::over(layer, scene);
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

/// Prepares what the metrics need of the two pictures.
EvaluatedMoment prepare(const DrawnMoment& drawn, const ExactMoment& exact, measure::ComparedMoment& moment) {
    EvaluatedMoment evaluated{{}, overScene(drawn.layer, drawn.scene), overScene(exact.layer, drawn.scene), {}};
    moment.picture = measure::preparePicture(evaluated.picture, "the method's picture");
    moment.reference = measure::preparePicture(evaluated.reference, "the reference");
    moment.alpha = measure::alphaOf(drawn.layer, "the method's layer");
    moment.referenceAlpha = measure::alphaOf(exact.layer, "the reference's layer");
    moment.mask = measure::dustMask(moment.alpha, moment.referenceAlpha);
    moment.flip = measure::flip(moment.reference, moment.picture);
    return evaluated;
}

void evaluate(measure::ComparedMoment& moment, EvaluatedMoment& evaluated) {
    evaluated.metrics.values = measure::valuesOf(moment);
    evaluated.difference = std::move(moment.flip.map);
}

std::optional<double> valueOfRun(const RunMetrics& runMetrics, const measure::Metric& metric) {
    if (metric.overRun == measure::OverRun::pairs || metric.overRun == measure::OverRun::whole)
        return runMetrics.ofRun.of(metric.column);
    double sum = 0;
    int count = 0;
    for (const MomentMetrics& moment : runMetrics.frames)
        if (const std::optional<double>& value = moment.values.of(metric.column)) {
            sum += *value;
            ++count;
        }
    if (count == 0) return std::nullopt;
    if (metric.overRun == measure::OverRun::all) return sum == count ? 1 : 0;
    return sum / count;
}

}  // namespace

EvaluatedMoment comparePictures(const DrawnMoment& drawn, const ExactMoment& exact) {
    measure::ComparedMoment moment;
    EvaluatedMoment evaluated = prepare(drawn, exact, moment);
    evaluate(moment, evaluated);
    return evaluated;
}

EvaluatedMoment evaluateMoment(const DrawnMoment& drawn, const ExactMoment& exact, const MomentFacts& facts) {
    measure::ComparedMoment moment;
    EvaluatedMoment evaluated = prepare(drawn, exact, moment);
    moment.alphaFree = measure::alphaOf(drawn.layerWithoutScene, "the method's layer without the scene");
    moment.referenceAlphaFree = measure::alphaOf(exact.layerWithoutScene, "the reference's layer without the scene");
    moment.continuum = measure::alphaOf(exact.continuum, "the continuum's layer");
    if (exact.ofOneColour)
        moment.continuumPicture = measure::preparePicture(overScene(exact.continuum, drawn.scene), "the continuum");
    moment.primitives = facts.primitives;
    moment.onScreen = primitivesOnScreen(facts.volume, facts.view);
    moment.seed = facts.seed;
    exports::ExtinctionGrid grid, referenceGrid;
    if (!facts.volume.isNothing() && !facts.referenceVolume.isNothing()) {
        const exports::GridPlan plan =
            exports::planGrid(facts.referenceVolume.bounds(), exports::VolumeSettings().resolution);
        referenceGrid = exports::computeGrid(facts.referenceVolume, plan);
        grid = exports::computeGrid(facts.volume, plan);
        moment.referenceGrid = measure::GridCells{plan.cells, referenceGrid.extinctionPerMetre};
        moment.grid = measure::GridCells{plan.cells, grid.extinctionPerMetre};
    }
    if (!facts.volume.isNothing())
        moment.volumeAlpha = reportedAlpha(facts.volume, facts.view, distancesFromDepth(facts.view, drawn.sceneDepth));
    evaluate(moment, evaluated);
    return evaluated;
}

std::optional<double> PoppingMeter::add(const DrawnMoment& drawn, const ExactMoment& exact,
                                        std::span<const measure::SizedPrimitive> primitives) {
    Kept now{measure::preparePicture(overScene(drawn.layer, drawn.scene), "the method's picture"),
             measure::preparePicture(overScene(exact.layer, drawn.scene), "the reference"),
             measure::alphaOf(drawn.layer, "the method's layer"),
             measure::alphaOf(exact.layer, "the reference's layer"),
             measure::largeAmong(primitives, drawn.layer.width, drawn.layer.height)};
    std::optional<double> value;
    if (before_) {
        const measure::DustFrame then{before_->image, before_->reference, before_->alpha, before_->referenceAlpha};
        const measure::DustFrame here{now.image, now.reference, now.alpha, now.referenceAlpha};
        value = measure::popping(then, here).value;
        summary_.add(value);
        if (value && before_->depths && now.depths) {
            const measure::PoppingBySize bySize = measure::poppingBySize(then, here, *before_->depths, *now.depths);
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

measure::PoppingOfRun PoppingMeter::ofRun() const {
    if (!summary_.mean()) return {summary_, {}};
    return {summary_, {small_.value(), large_.value(), smallPart_.value(), largePart_.value()}};
}

std::string metricsCsv(const RunMetrics& runMetrics) {
    const auto hasFrames = [](const measure::Metric& metric) { return metric.overRun != measure::OverRun::whole; };
    std::string text = "frame,time_s";
    for (const measure::Metric& metric : measure::metrics())
        if (hasFrames(metric)) text.append(",").append(metric.column);
    text += "\n";
    for (const MomentMetrics& moment : runMetrics.frames) {
        text += std::to_string(moment.frame) + "," + files::csvNumber(moment.timeSeconds);
        for (const measure::Metric& metric : measure::metrics()) {
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
    for (const measure::Metric& metric : measure::metrics())
        if (const std::optional<double> value = valueOfRun(runMetrics, metric))
            cells.emplace_back(metric.column, *value);
    return cells;
}

std::string volumeWarning(const RunMetrics& runMetrics) {
    for (const auto& [column, value] : summaryOf(runMetrics))
        if (column == "volume_picture" && value > measure::maximumVolumePicture)
            return fmt::format(
                "the method does not draw the volume that it reports: volume_picture is {:.2f}, allowed: up to {}; "
                "volume_error describes that volume, not the picture",
                value, measure::maximumVolumePicture);
    return {};
}

}  // namespace dustbench::reference
