#include "bench/report/chart_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "bench/export/whole_file.h"
#include "bench/report/drawing_program.h"
#include "bench/report/report_files.h"
#include "bench/report/report_json.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> formats{"svg", "png", "pdf"};

std::string withoutQuick(std::string id) {
    const std::string quick = "-quick";
    if (const std::size_t at = id.rfind(quick); at != std::string::npos) id.erase(at, quick.size());
    return id;
}

/// The only id that equals `wanted` or ends with it, ignoring `-quick`.
std::string resolved(const ReportData& data, const std::string& wanted) {
    const std::vector<std::string> ids = chartIds(data);
    if (std::ranges::find(ids, wanted) != ids.end()) return wanted;
    for (const bool asWritten : {true, false}) {
        std::vector<std::string> ending;
        for (const std::string& id : ids) {
            const std::string name = asWritten ? id : withoutQuick(id);
            if (name == wanted || name.ends_with("-" + wanted)) ending.push_back(id);
        }
        if (ending.size() == 1) return ending.front();
    }
    throw unknownName("chart", wanted, ids);
}

/// The page combines the seeds of a cell.
std::size_t countWithoutSeeds(const RunGroup& group) {
    std::set<std::tuple<std::string, std::map<std::string, std::string, std::less<>>, std::size_t>> cells;
    for (const ReportCell& cell : group.cells) {
        auto settings = cell.settings;
        settings.erase("seed");
        cells.emplace(cell.method, std::move(settings), cell.machine);
    }
    return cells.size();
}

bool hasColumn(const RunGroup& group, std::string_view column) {
    return std::ranges::any_of(group.cells, [column](const ReportCell& cell) { return cell.values.contains(column); });
}

/// Suites that are used only by the controls of claims.
bool isOfControls(const ReportData& data, const RunGroup& group) {
    return std::ranges::any_of(data.papers, [&group](const suite::Paper& paper) {
        return std::ranges::find(paper.controls, group.suite) != paper.controls.end() &&
               std::ranges::find(paper.suites, group.suite) == paper.suites.end();
    });
}

/// The same columns as in charts.js: costs and metrics from columns.json, facts of methods.
bool hasCostChart(const RunGroup& group) {
    const auto isDrawn = [](const ReportCell& cell) { return !cell.values.empty(); };
    return std::ranges::any_of(group.cells, isDrawn) && countWithoutSeeds(group) > 1;
}

/// The settings of a cell without the number along which its claim is tested; nullopt if the cell lacks that number.
std::optional<claims::Selection> othersThan(const std::string& along, claims::Selection cell) {
    const auto place = std::ranges::find(cell, along, &claims::Selection::value_type::first);
    if (place == cell.end()) return std::nullopt;
    cell.erase(place);
    return cell;
}

/// Maps of claims, as map_chart.js lists them: for each paper and number along which claims are tested, if a claim has
/// another setting as well.
std::vector<std::string> mapIds(const ReportData& data) {
    std::vector<std::string> ids;
    for (const suite::Paper& paper : data.papers)
        for (const claims::EvaluatedClaim& evaluated : data.claims) {
            const std::string& along = evaluated.claim.rule.along;
            if (evaluated.paper != paper.id || along.empty()) continue;
            std::set<std::optional<claims::Selection>> others;
            for (const claims::ClaimCell& cell : evaluated.result.cells) others.insert(othersThan(along, cell.cell));
            const std::string id = fmt::format("{}-by-{}", paper.id, claims::nameOf(along));
            if (others.size() > 1 && !others.contains(std::nullopt) && std::ranges::find(ids, id) == ids.end())
                ids.push_back(id);
        }
    return ids;
}

}  // namespace

std::vector<std::string> chartIds(const ReportData& data) {
    std::vector<std::string> ids;
    for (const RunGroup& group : data.groups) {
        if (hasCostChart(group)) ids.push_back(group.id);
        if (hasColumn(group, "frame_ms_median")) ids.push_back(group.id + "-stages");
        if (hasColumn(group, "flip")) ids.push_back(group.id + "-quality");
    }
    std::ranges::move(mapIds(data), std::back_inserter(ids));
    if (!data.frameTimes.empty()) ids.emplace_back("frames");
    return ids;
}

void drawChart(const ReportData& data, const std::string& id, const fs::path& file, const std::string& what) {
    const std::string ending = file.extension().string();
    const std::string format = ending.empty() ? ending : ending.substr(1);
    if (std::ranges::find(formats, format) == formats.end())
        throw InputError(
            fmt::format("{}: got '{}', allowed: a file that ends in .svg, .png or .pdf", what, file.string()));
    std::error_code error;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
    if (error) files::failWriting(file.parent_path(), error.value());

    exports::WholeFile script(file.string() + ".js"), svg(file.string() + ".svg"), drawn(file),
        log(file.string() + ".log");
    exports::writeWhole(script.temporaryPath(),
                        fmt::format("{}\n{}\nconst reportColumns = {};\nconst reportCharts = {};\n"
                                    "const reportData = {};\n{}",
                                    vegaScript(), chartScript(), reportColumns(), chartSpecifications(),
                                    reportJson(data), reportFile("chart_file.js")));
    callDrawingProgram({"node", script.temporaryPath().string(), id, svg.temporaryPath().string()}, "nodejs",
                       log.temporaryPath());
    if (format == "svg")
        fs::rename(svg.temporaryPath(), drawn.temporaryPath());
    else
        convertSvg(svg.temporaryPath(), format, 2, drawn.temporaryPath(), log.temporaryPath());
    drawn.publish();
}

std::vector<fs::path> writeCharts(const ReportData& data, const std::string& id, const ChartTarget& target) {
    const std::string ending = target.out.extension().string();
    const bool isFile = !ending.empty() && std::ranges::find(formats, ending.substr(1)) != formats.end();
    std::string format = target.format;
    if (format.empty()) format = isFile ? ending.substr(1) : "svg";
    if (std::ranges::find(formats, format) == formats.end())
        throw InputError(fmt::format("--format: got '{}', allowed: {}", format, fmt::join(formats, ", ")));
    if (isFile && ending.substr(1) != format)
        throw InputError(
            fmt::format("--out: got '{}' with the format {}, allowed: a file that ends in .{}, or a folder",
                        target.out.string(), format, format));
    std::vector<std::string> ids;
    if (id != "all") {
        ids = {resolved(data, id)};
    } else {
        for (const RunGroup& group : data.groups)
            if (!group.suite.empty() && !isOfControls(data, group) && hasCostChart(group)) ids.push_back(group.id);
        std::ranges::move(mapIds(data), std::back_inserter(ids));
    }
    if (isFile && ids.size() != 1)
        throw InputError(
            fmt::format("--out: got the file '{}' for {} charts, allowed: a folder", target.out.string(), ids.size()));
    const fs::path folder = target.out.empty() ? target.folder / "charts" : target.out;
    if (!isFile) exports::removeUnfinished(folder);
    std::vector<fs::path> files;
    for (const std::string& each : ids) {
        files.push_back(isFile ? target.out : folder / fmt::format("{}.{}", each, format));
        drawChart(data, each, files.back(), "--out");
    }
    return files;
}

}  // namespace dustbench::report
