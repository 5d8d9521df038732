#include "bench/report/report_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/measure/image/heat_map.h"
#include "bench/measure/provenance.h"
#include "bench/report/json_parts.h"
#include "bench/report/run_groups.h"
#include "bench/results/method_facts.h"
#include "bench/suite/catalogue.h"
#include "methods/kit/maths/srgb.h"

namespace dustbench::report {
namespace {

using nlohmann::json;

using RunIndex = std::map<std::string, std::size_t, std::less<>>;

json indices(const RunIndex& index, const std::vector<std::string>& ids) {
    json list = json::array();
    for (const std::string& id : ids)
        if (const auto found = index.find(id); found != index.end()) list.push_back(found->second);
    return list;
}

json axisJson(const ReportAxis& axis) {
    return {{"name", axis.name},   {"unit", axis.unit},       {"help", axis.help},
            {"world", axis.world}, {"numeric", axis.numeric}, {"values", axis.values}};
}

json cellJson(const RunGroup& group, const ReportCell& cell, const RunIndex& index) {
    json values = json::object();
    for (const auto& [column, interval] : cell.values)
        values[column] = interval.values == 1
                             ? json(number(interval.median))
                             : json{number(interval.median), number(interval.low), number(interval.high)};
    std::vector<std::string> ids;
    ids.reserve(cell.done.size());
    for (const results::StoredRun* run : cell.done) ids.push_back(run->runId);
    const double probability = cell.values.empty() ? 0 : cell.values.begin()->second.probability;
    return {{"method", cell.method},
            {"variant", variantLabel(group, cell)},
            {"world", worldLabel(group, cell)},
            {"settings", cell.settings},
            {"machine", cell.machine},
            {"failed", cell.failed},
            {"probability", number(probability)},
            {"runs", indices(index, ids)},
            {"values", std::move(values)}};
}

json fitJson(const ReportFit& entry) {
    const measure::CostFit& fit = entry.fit;
    return {{"axis", entry.axis},
            {"column", entry.column},
            {"method", entry.method},
            {"settings", entry.settings},
            {"machine", entry.machine},
            {"a", {number(fit.fixedMs.value), number(fit.fixedMs.plusMinus)}},
            {"b", {number(fit.factor.value), number(fit.factor.plusMinus)}},
            {"k", {number(fit.exponent.value), number(fit.exponent.plusMinus)}},
            {"loads", fit.loads},
            {"runs", fit.runs},
            {"scatter", number(fit.relativeError)}};
}

json publishedJson(const PublishedPoint& point) {
    return {{"method", point.method},       {"settings", point.settings}, {"axis", point.axis},
            {"x", number(point.x)},         {"column", point.column},     {"min", number(point.minimum)},
            {"max", number(point.maximum)}, {"hardware", point.hardware}, {"what", point.what}};
}

json verdictJson(const suite::CellVerdict& cell) {
    return {{"at", cell.at},
            {"ratio", number(cell.result.ratio)},
            {"low", number(cell.result.low)},
            {"high", number(cell.result.high)},
            {"pairs", cell.result.pairs},
            {"verdict", measure::verdictName(cell.result.verdict)}};
}

json comparisonJson(const suite::ComparisonResult& comparison) {
    return {{"of", comparison.of},
            {"with", comparison.with},
            {"axes", comparison.axes},
            {"columns", each(comparison.columns, [](const suite::ColumnVerdict& column) {
                 return json{{"column", column.column},
                             {"cells", each(column.cells, verdictJson)},
                             {"overall", verdictJson(column.overall)}};
             })}};
}

json groupJson(const RunGroup& group, const RunIndex& index) {
    return {{"id", group.id},
            {"suite", group.suite},
            {"title", group.title},
            {"summary", group.summary},
            {"paper", group.paper},
            {"toml", group.suiteText},
            {"chart", {{"column", group.chart.column}, {"against", group.chart.against}}},
            {"common", group.common},
            {"axes", each(group.axes, axisJson)},
            {"cells", each(group.cells, [&](const ReportCell& cell) { return cellJson(group, cell, index); })},
            {"fits", each(group.fits, fitJson)},
            {"published", each(group.published, publishedJson)},
            {"budgetMs", group.budgetMs ? number(*group.budgetMs) : json()},
            {"comparisons", each(group.comparisons, comparisonJson)}};
}

json frameTimesJson(const FrameTimes& times, const RunIndex& index) {
    json trace = json::array();
    for (const auto& [frame, ms] : times.trace) trace.push_back({frame, number(ms)});
    return {{"run", index.at(times.runId)},
            {"experiment", times.group},
            {"label", times.label},
            {"frames", times.frames},
            {"minimumMs", number(times.minimumMs)},
            {"binMs", number(times.binMs)},
            {"bins", times.bins},
            {"trace", std::move(trace)}};
}

json pictureSetJson(const PictureSet& set, const std::string& root) {
    json pictures = json::array();
    for (const ReportPicture& picture : set.pictures) {
        json numbers = json::object();
        for (const auto& [column, value] : picture.numbers) numbers[column] = number(value);
        pictures.push_back({{"label", picture.label},
                            {"method", picture.method},
                            {"difference", picture.difference},
                            {"source", picture.source.starts_with("data:") ? picture.source : root + picture.source},
                            {"numbers", std::move(numbers)}});
    }
    return {{"experiment", set.group}, {"world", set.world},   {"frame", set.frame},
            {"width", set.width},      {"height", set.height}, {"pictures", std::move(pictures)}};
}

/// The colours of difference maps as `#rrggbb`, from no difference to the maximum.
json heatColours() {
    constexpr int steps = 16;
    json colours = json::array();
    for (int step = 0; step <= steps; ++step) {
        const glm::vec3 linear = measure::heatColour(static_cast<float>(step) / steps);
        const auto byte = [](float value) { return std::lround(255 * maths::encodeSrgb(value)); };
        colours.push_back(fmt::format("#{:02x}{:02x}{:02x}", byte(linear.r), byte(linear.g), byte(linear.b)));
    }
    return colours;
}

}  // namespace

std::string reportJson(const ReportData& data) {
    RunIndex index;
    json runs = json::array();
    for (const auto& [id, run] : data.runs) {
        index[id] = runs.size();
        runs.push_back(id);
    }
    json root{{"folder", data.folder},
              {"root", data.root},
              {"tablesOnly", data.tablesOnly},
              {"written", data.writtenUtc},
              {"version", measure::buildFacts().version},
              {"problems", data.problems},
              {"machines", data.machines},
              {"files", data.files},
              {"heat", heatColours()},
              {"runs", std::move(runs)},
              {"framesLeftOut", data.runsWithoutFrameTimes},
              {"linkedPictures", data.linkedPictures}};
    // All methods of this build, so that a method has the same colour in every report.
    root["methods"] = each(suite::catalogue("methods"), [](const suite::CatalogueItem& item) {
        return json{{"id", item.id}, {"title", item.title}};
    });
    root["facts"] = each(results::methodFacts(), [](const results::MethodFact& fact) {
        return json{{"name", fact.info.name}, {"unit", fact.info.unit}, {"meaning", fact.info.meaning}};
    });
    root["papers"] = each(data.papers, [](const suite::Paper& paper) {
        return json{
            {"id", paper.id},       {"title", paper.title},     {"authors", paper.authors},  {"year", paper.year},
            {"venue", paper.venue}, {"summary", paper.summary}, {"controls", paper.controls}};
    });
    root["experiments"] = each(data.groups, [&](const RunGroup& item) { return groupJson(item, index); });
    root["claims"] = each(data.claims, [&](const claims::EvaluatedClaim& item) {
        json claim = claimJson(item);
        claim["runs"] = indices(index, item.result.runs);
        return claim;
    });
    root["frames"] = each(data.frameTimes, [&](const FrameTimes& item) { return frameTimesJson(item, index); });
    root["pictures"] = each(data.pictureSets, [&](const PictureSet& set) { return pictureSetJson(set, data.root); });
    root["notDone"] = each(data.notDone, [](const NotDone& item) {
        return json{{"run", item.runId}, {"status", item.status}, {"reason", item.reason}};
    });
    root["warnings"] = each(data.warnings, [&](const RunWarnings& item) {
        return json{{"warning", item.warning}, {"runs", indices(index, item.runs)}};
    });
    return scriptSafe(root);
}

}  // namespace dustbench::report
