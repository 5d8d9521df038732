// Image metrics as declarations: each with its column, what lists, documents and pages say of it, and its function.
//
// A file NAME_metric.cpp of this folder declares the metrics that it computes together:
//
//     namespace dustbench::measure::NAME_metric {
//     MetricGroup describe() { … }
//     }
//
// CMake generates the list from these files. The columns of metrics.csv and summary.csv, `dustbench list metrics`, the
// report's columns and the tables of reports/METRICS.md and reports/SCHEMA.md are made from it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/measure/image/masked_error.h"
#include "bench/measure/image/popping.h"
#include "bench/measure/image/volume_error.h"

namespace dustbench::measure {

/// What a metric needs, and thereby the reference that it refers to.
enum class Needs {
    pictures,            ///< picture, alpha and mask, of method and particles
    layersWithoutScene,  ///< also the alphas without the scene's depth
    primitives,          ///< also what the method draws
    grids,               ///< the extinction of the method's volume and of the particles
    continuum,           ///< the alpha of the continuum
    continuumPicture,    ///< its picture
    ownVolume,           ///< the alpha of the volume that the method reports
    pairs                ///< consecutive frames, with the particles
};

/// How the value of a run follows from its frames.
enum class OverRun {
    mean,   ///< over the compared frames in which it is defined
    all,    ///< 1 if it is 1 in all compared frames, else 0
    pairs,  ///< from pairs of consecutive frames, each with a value in metrics.csv
    whole   ///< from these pairs, without values in metrics.csv
};

/// Texts are Markdown.
struct Metric {
    std::string_view column;
    std::string_view title;       ///< one line
    std::string_view definition;  ///< for reports/METRICS.md
    std::string_view range;       ///< `0 … 1`
    std::string_view unit{};
    std::string_view emptyWhen = "never";
    std::string_view source{};     ///< a key of data/references.bib
    std::string_view perfect;      ///< the value of an image that equals the reference: `0`, `identical`, `any`
    bool higherIsBetter = false;   ///< for `any` and others: which one costs less
    std::string_view chartName{};  ///< on charts; empty: not on charts
    bool ranks = false;            ///< `dustbench recommend` can rank pictures by it
    bool isFlaw = false;           ///< `dustbench recommend` and the report list it as a flaw
    OverRun overRun = OverRun::mean;
    Needs needs = Needs::pictures;

    // Columns of results stay where they are, so the metrics of older results have fixed places. Others need none: they
    // follow at the end.
    int place = 1000;  ///< in lists and in metrics.csv
    int round = 6;     ///< of the extensions of summary.csv (bench/results/summary.cpp)
};

/// A method's pictures of one moment and their references; empty if not available.
struct ComparedMoment {
    Picture picture, reference;              ///< over the scene; the reference is that of the particles
    Plane alpha, referenceAlpha;             ///< of the dust alone
    Mask mask;                               ///< of both alphas
    Measured flip;                           ///< the metric flip; its map is also a picture of its own
    Plane alphaFree, referenceAlphaFree;     ///< drawn without the scene's depth
    std::optional<std::int64_t> primitives;  ///< handed to the GPU by the method
    std::vector<ScreenPrimitive> onScreen;   ///< of the volume that the method reports
    std::uint64_t seed = 1;
    std::optional<GridCells> grid, referenceGrid;  ///< the caller owns the cells
    Plane continuum;                               ///< alpha
    std::optional<Picture> continuumPicture;       ///< over the scene
    Plane volumeAlpha;                             ///< of the volume that the method reports
};

/// Popping of a run.
struct PoppingOfRun {
    PoppingSummary summary;
    PoppingBySize bySize;
};

/// Metrics that are computed together. A function returns a value for each, in their order.
struct MetricGroup {
    using Values = std::vector<std::optional<double>>;

    std::vector<Metric> metrics;
    std::function<Values(const ComparedMoment&)> ofMoment{};  ///< called if the moment has what the first metric needs
    std::function<Values(const PoppingOfRun&)> ofRun{};       ///< instead, for metrics of pairs
};

/// All metrics in the order of lists.
[[nodiscard]] const std::vector<Metric>& metrics();

/// The name of the reference in documents: `particles`, `continuum`, `the method's own volume`.
[[nodiscard]] std::string_view referenceOf(const Metric& metric);

/// A value for each metric, or none where it is undefined or not computed.
class MetricValues {
 public:
    /// Throw std::invalid_argument for a name that no metric has.
    [[nodiscard]] const std::optional<double>& of(std::string_view column) const;
    void set(std::string_view column, const std::optional<double>& value);

 private:
    std::vector<std::optional<double>> values_ = std::vector<std::optional<double>>(metrics().size());
};

/// The metrics for which the moment has what they need.
[[nodiscard]] MetricValues valuesOf(const ComparedMoment& moment);
/// The metrics of a run that come from pairs of frames.
[[nodiscard]] MetricValues valuesOf(const PoppingOfRun& run);

}  // namespace dustbench::measure
