#include "bench/reference/judge/moment_metrics.h"

#include "bench/export/extinction_grid.h"
#include "bench/measure/image/banding.h"
#include "bench/measure/image/cutoff.h"
#include "bench/measure/image/flip.h"
#include "bench/measure/image/image_check.h"
#include "bench/measure/image/masked_error.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/quads_per_pixel.h"
#include "bench/measure/image/self_similarity.h"
#include "bench/measure/image/ssim.h"
#include "bench/measure/image/trail_gaps.h"
#include "bench/measure/image/volume_error.h"
#include "bench/measure/image/volume_picture.h"
#include "bench/reference/judge/reported_depths.h"

namespace dustbench::bench {
namespace {

/// Computed on the default export grid of the reference.
std::optional<double> volumeErrorOf(const CollectedVolume& volume, const CollectedVolume& exact) {
    if (volume.isNothing() || exact.isNothing()) return std::nullopt;
    const GridPlan plan = planGrid(exact.bounds(), VolumeSettings().resolution);
    const ExtinctionGrid reference = computeGrid(exact, plan), grid = computeGrid(volume, plan);
    return volumeError({plan.cells, reference.extinctionPerMetre}, {plan.cells, grid.extinctionPerMetre}).value;
}

/// The pixels are opaque up to rounding; the metrics require exactly 1.
pictures::Image overScene(const pictures::Image& layer, const pictures::Image& scene) {
    pictures::Image image = pictures::over(layer, scene);
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

std::optional<double> asNumber(const std::optional<int>& value) {
    return value ? std::optional<double>(*value) : std::nullopt;
}

/// The pictures of a moment, prepared for the metrics.
struct PreparedMoment {
    pictures::Image image, referenceImage;
    Picture picture, reference;
    Plane alpha, exactAlpha;
};

PreparedMoment prepare(const DrawnMoment& drawn, const ExactMoment& exact) {
    PreparedMoment prepared;
    prepared.image = overScene(drawn.layer, drawn.scene);
    prepared.referenceImage = overScene(exact.layer, drawn.scene);
    prepared.picture = preparePicture(prepared.image, "the method's picture");
    prepared.reference = preparePicture(prepared.referenceImage, "the reference");
    prepared.alpha = alphaOf(drawn.layer, "the method's layer");
    prepared.exactAlpha = alphaOf(exact.layer, "the reference's layer");
    return prepared;
}

/// The metrics that need only the two pictures.
JudgedMoment compare(const PreparedMoment& prepared) {
    const auto& [image, referenceImage, picture, reference, alpha, exactAlpha] = prepared;
    JudgedMoment judged{{}, image, referenceImage, {}};
    MomentMetrics& metrics = judged.metrics;
    const PictureError error = pictureError(reference, picture);
    metrics.psnrDb = error.psnrDb;
    metrics.identical = error.identical;
    metrics.rmseLinear = error.rmseLinear;
    const Mask mask = dustMask(alpha, exactAlpha);
    const MaskedError masked = maskedError(reference, picture, mask);
    metrics.psnrMaskDb = masked.psnrDb;
    metrics.rmseLinearMask = masked.rmseLinear;
    metrics.banding = banding(reference, picture, mask);
    metrics.errorMax = masked.maximum;
    const Measured similarity = ssim(reference, picture);
    metrics.ssim = similarity.value;
    metrics.ssimMask = meanWithin(similarity.map, mask);
    Measured flipped = flip(reference, picture);
    metrics.flip = flipped.value;
    metrics.flipMask = meanWithin(flipped.map, mask);
    judged.difference = std::move(flipped.map);
    return judged;
}

}  // namespace

JudgedMoment comparePictures(const DrawnMoment& drawn, const ExactMoment& exact) {
    return compare(prepare(drawn, exact));
}

JudgedMoment judgeMoment(const DrawnMoment& drawn, const ExactMoment& exact, const MomentFacts& facts) {
    const PreparedMoment prepared = prepare(drawn, exact);
    const auto& [image, referenceImage, picture, reference, alpha, exactAlpha] = prepared;
    const Plane alphaFree = alphaOf(drawn.layerWithoutScene, "the method's layer without the scene");
    const Plane exactFree = alphaOf(exact.layerWithoutScene, "the reference's layer without the scene");
    const Plane continuum = alphaOf(exact.continuum, "the continuum's layer");

    JudgedMoment judged = compare(prepared);
    MomentMetrics& metrics = judged.metrics;
    if (exact.ofOneColour)
        metrics.psnrContinuumDb =
            pictureError(preparePicture(overScene(exact.continuum, drawn.scene), "the continuum"), picture).psnrDb;
    metrics.gaps = gaps(alpha, continuum).value;
    metrics.spill = spill(alpha, continuum).value;
    const TrailParts parts = components(alpha, continuum);
    metrics.components = asNumber(parts.parts);
    metrics.componentsReference = asNumber(parts.referenceParts);
    metrics.cutoff = cutoff(alpha, alphaFree, exactAlpha, exactFree).value;
    metrics.selfSimilarity =
        selfSimilarity(alpha, exactAlpha, primitivesOnScreen(facts.volume, facts.view), facts.seed).value;
    metrics.quadsPerPixel = quadsPerPixel(facts.primitives, exactAlpha);
    metrics.volumeError = volumeErrorOf(facts.volume, facts.referenceVolume);
    if (!facts.volume.isNothing())
        metrics.volumePicture = volumePicture(
            alpha, reportedAlpha(facts.volume, facts.view, distancesFromDepth(facts.view, drawn.sceneDepth)));
    return judged;
}

std::optional<double> PoppingJudge::add(const DrawnMoment& drawn, const ExactMoment& exact,
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

void PoppingJudge::Mean::add(const std::optional<double>& value) {
    if (!value) return;
    sum += *value;
    ++count;
}

std::optional<double> PoppingJudge::Mean::value() const {
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

PoppingBySize PoppingJudge::bySize() const {
    if (!summary_.mean()) return {};
    return {small_.value(), large_.value(), smallPart_.value(), largePart_.value()};
}

}  // namespace dustbench::bench
