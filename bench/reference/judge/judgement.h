// The metrics of one moment and of a run, as defined in reports/METRICS.md: a row of metrics.csv for each frame with
// metrics, and columns of summary.csv.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure/image/metric.h"
#include "bench/reference/judge/moment_pictures.h"

namespace dustbench::reference {

/// `popping` is the value from the previous frame to this one.
struct MomentMetrics {
    std::int64_t frame = 0;
    double timeSeconds = 0;
    measure::MetricValues values{};
};

/// Data for the metrics of a moment, other than its pictures.
struct MomentFacts {
    std::int64_t primitives = 0;  ///< handed to the GPU by the method
    const exports::CollectedVolume& volume;
    const exports::CollectedVolume& referenceVolume;
    const scene::View& view;
    std::uint64_t seed = 1;
};

struct EvaluatedMoment {
    MomentMetrics metrics;
    pictures::Image picture;    ///< over the scene
    pictures::Image reference;  ///< over the scene
    measure::Plane difference;  ///< FLIP map
};

/// The metrics that need only the two pictures; all others are empty.
[[nodiscard]] EvaluatedMoment comparePictures(const DrawnMoment& drawn, const ExactMoment& exact);
/// All metrics except popping. `exact` must have all its layers.
[[nodiscard]] EvaluatedMoment evaluateMoment(const DrawnMoment& drawn, const ExactMoment& exact,
                                             const MomentFacts& facts);

/// Computes popping over consecutive frames.
class PoppingMeter {
 public:
    /// Adds the next frame of the stretch; returns nothing for the first. `primitives`: those that the method draws.
    std::optional<double> add(const DrawnMoment& drawn, const ExactMoment& exact,
                              std::span<const measure::SizedPrimitive> primitives = {});
    /// Values by size are means over the pairs; a pair in which a side has no pixel adds nothing to that side.
    [[nodiscard]] measure::PoppingOfRun ofRun() const;

 private:
    struct Kept {
        measure::Picture image, reference;
        measure::Plane alpha, referenceAlpha;
        std::optional<measure::SizeDepths> depths;
    };
    struct Mean {
        double sum = 0;
        std::int64_t count = 0;

        void add(const std::optional<double>& value);
        [[nodiscard]] std::optional<double> value() const;
    };
    std::optional<Kept> before_;
    measure::PoppingSummary summary_;
    Mean small_, large_, smallPart_, largePart_;
};

/// Metrics of one run; frames ascending.
struct RunMetrics {
    std::vector<MomentMetrics> frames;  ///< moments, and the consecutive frames for popping, which have only popping
    measure::MetricValues ofRun{};      ///< those of pairs of frames
};

/// `frame,time_s,` and every metric with values of frames.
[[nodiscard]] std::string metricsCsv(const RunMetrics& runMetrics);

/// Means over the moments at which a metric is defined, by column of summary.csv; `identical` is 1 if all moments are
/// identical. Metrics that are never defined are omitted.
[[nodiscard]] std::vector<std::pair<std::string, double>> summaryOf(const RunMetrics& runMetrics);

/// A warning if the mean of `volume_picture` (bench/measure/image/volume_error.h) shows that the method draws other
/// volumes than it reports; else empty.
[[nodiscard]] std::string volumeWarning(const RunMetrics& runMetrics);

}  // namespace dustbench::reference
