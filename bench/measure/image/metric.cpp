#include "bench/measure/image/metric.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace dustbench::measure {

/// Generated from the files NAME_metric.cpp (metric_list.cpp.in).
std::vector<MetricGroup> describeMetrics();

namespace {

const std::vector<MetricGroup>& metricGroups() {
    static const std::vector<MetricGroup> groups = describeMetrics();
    return groups;
}

std::size_t indexOf(std::string_view column) {
    const auto found = std::ranges::find(metrics(), column, &Metric::column);
    if (found == metrics().end()) throw std::invalid_argument("no metric '" + std::string(column) + "'");
    return static_cast<std::size_t>(found - metrics().begin());
}

bool has(const ComparedMoment& moment, Needs needs) {
    switch (needs) {
        case Needs::pictures:
            return true;
        case Needs::layersWithoutScene:
            return !moment.alphaFree.values.empty() && !moment.referenceAlphaFree.values.empty();
        case Needs::primitives:
            return moment.primitives.has_value();
        case Needs::grids:
            return moment.grid && moment.referenceGrid;
        case Needs::continuum:
            return !moment.continuum.values.empty();
        case Needs::continuumPicture:
            return moment.continuumPicture.has_value();
        case Needs::ownVolume:
            return !moment.volumeAlpha.values.empty();
        case Needs::pairs:
            return false;
    }
    return false;
}

void add(const MetricGroup& group, const MetricGroup::Values& values, MetricValues& all) {
    for (std::size_t i = 0; i < group.metrics.size(); ++i) all.set(group.metrics[i].column, values.at(i));
}

}  // namespace

const std::vector<Metric>& metrics() {
    static const std::vector<Metric> list = [] {
        std::vector<Metric> all;
        for (const MetricGroup& group : metricGroups())
            all.insert(all.end(), group.metrics.begin(), group.metrics.end());
        std::ranges::sort(all, {},
                          [](const Metric& metric) { return std::tuple(metric.overRun, metric.place, metric.column); });
        return all;
    }();
    return list;
}

std::string_view referenceOf(const Metric& metric) {
    if (metric.needs == Needs::continuum || metric.needs == Needs::continuumPicture) return "continuum";
    return metric.needs == Needs::ownVolume ? "the method's own volume" : "particles";
}

const std::optional<double>& MetricValues::of(std::string_view column) const {
    return values_[indexOf(column)];
}

void MetricValues::set(std::string_view column, const std::optional<double>& value) {
    values_[indexOf(column)] = value;
}

MetricValues valuesOf(const ComparedMoment& moment) {
    MetricValues values;
    for (const MetricGroup& group : metricGroups())
        if (group.ofMoment && has(moment, group.metrics.front().needs)) add(group, group.ofMoment(moment), values);
    return values;
}

MetricValues valuesOf(const PoppingOfRun& run) {
    MetricValues values;
    for (const MetricGroup& group : metricGroups())
        if (group.ofRun) add(group, group.ofRun(run), values);
    return values;
}

}  // namespace dustbench::measure
