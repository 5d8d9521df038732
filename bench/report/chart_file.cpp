#include "bench/report/chart_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "bench/export/whole_file.h"
#include "bench/report/drawing_program.h"
#include "bench/report/report_files.h"
#include "bench/report/report_json.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::bench {
namespace {

namespace fs = std::filesystem;

std::string withoutQuick(std::string id) {
    const std::string quick = "-quick";
    if (const std::size_t at = id.rfind(quick); at != std::string::npos) id.erase(at, quick.size());
    return id;
}

/// The only id that equals `wanted` or ends in it, ignoring `-quick`.
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

/// The page shows the seeds of a cell as one.
std::size_t countWithoutSeeds(const RunGroup& group) {
    std::set<std::tuple<std::string, std::map<std::string, std::string, std::less<>>, std::size_t>> cells;
    for (const ReportCell& cell : group.cells) {
        auto settings = cell.settings;
        settings.erase("seed");
        cells.emplace(cell.method, std::move(settings), cell.machine);
    }
    return cells.size();
}

}  // namespace

std::vector<std::string> chartIds(const ReportData& data) {
    std::vector<std::string> ids;
    for (const RunGroup& group : data.groups) {
        const auto has = [&group](std::string_view column) {
            return std::ranges::any_of(group.cells,
                                       [column](const ReportCell& cell) { return cell.values.contains(column); });
        };
        if (!has("frame_ms_median")) continue;
        if (countWithoutSeeds(group) > 1) ids.push_back(group.id);
        ids.push_back(group.id + "-stages");
        if (has("flip")) ids.push_back(group.id + "-quality");
    }
    if (!data.frameTimes.empty()) ids.emplace_back("frames");
    return ids;
}

fs::path writeChart(const fs::path& folder, const ReportData& data, const std::string& id, const std::string& format) {
    constexpr std::array<std::string_view, 3> formats{"svg", "png", "pdf"};
    if (std::ranges::find(formats, format) == formats.end())
        throw InputError(fmt::format("--format: got '{}', allowed: svg, png, pdf", format));
    const std::string chart = resolved(data, id);
    const fs::path place = folder / "charts" / fmt::format("{}.{}", chart, format);
    std::error_code error;
    fs::create_directories(place.parent_path(), error);
    if (error) files::failWriting(place.parent_path(), error.value());
    removeUnfinished(place.parent_path());

    WholeFile script(place.string() + ".js"), svg(place.string() + ".svg"), drawn(place), log(place.string() + ".log");
    writeWhole(script.beside(), fmt::format("{}\n{}\nconst reportColumns = {};\nconst reportCharts = {};\n"
                                            "const reportData = {};\n{}",
                                            vegaScript(), chartScript(), reportFile("columns.json"),
                                            chartSpecifications(), reportJson(data), reportFile("chart_file.js")));
    callDrawingProgram({"node", script.beside().string(), chart, svg.beside().string()}, "nodejs", log.beside());
    if (format == "svg")
        fs::rename(svg.beside(), drawn.beside());
    else
        convertSvg(svg.beside(), format, 2, drawn.beside(), log.beside());
    drawn.publish();
    return place;
}

}  // namespace dustbench::bench
