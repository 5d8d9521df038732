#include "bench/report/report_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "bench/measure/image/metric.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/shipped_folder.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

struct VegaModule {
    const char *name, *file;  // the name by which others require it, and its file in Debian
};
/// Debian ships Vega in modules that require each other by name. Those for maps and text clouds are omitted.
constexpr std::array<VegaModule, 20> vegaModules{{{"util", "util"},
                                                  {"statistics", "statistics"},
                                                  {"time", "time"},
                                                  {"format", "format"},
                                                  {"loader", "loader"},
                                                  {"dataflow", "dataflow"},
                                                  {"scale", "scale"},
                                                  {"canvas", "canvas"},
                                                  {"scenegraph", "scenegraph"},
                                                  {"transforms", "transforms"},
                                                  {"view-transforms", "view-transforms"},
                                                  {"encode", "encode"},
                                                  {"expression", "expression"},
                                                  {"selections", "selection"},
                                                  {"event-selector", "event-selector"},
                                                  {"functions", "functions"},
                                                  {"runtime", "runtime"},
                                                  {"view", "view"},
                                                  {"parser", "parser"},
                                                  {"interpreter", "interpreter"}}};

fs::path reportsFolder() {
    return files::shippedFolder("reports", "share/dustbench/reports");
}

/// Vega's scripts: those shipped with the program, else the system's.
fs::path vegaFolder() {
    const fs::path shipped = reportsFolder() / "vega";
    return fs::is_directory(shipped) ? shipped : fs::path(DUSTBENCH_VEGA_FOLDER);
}

std::string joined(std::initializer_list<std::string_view> names) {
    std::string script;
    for (const std::string_view name : names) script += reportFile(name);
    return script;
}

}  // namespace

std::string fileText(const fs::path& file) {
    return files::wholeText(file, "a part of the report");
}

std::string reportFile(std::string_view name) {
    return fileText(reportsFolder() / "page" / name);
}

std::string reportColumns() {
    const auto others = nlohmann::ordered_json::parse(reportFile("columns.json"));
    nlohmann::ordered_json columns;
    const auto addOthers = [&](bool cost) {
        for (const auto& [column, shown] : others.items())
            if (shown.contains("cost") == cost) columns[column] = shown;
    };
    addOthers(true);
    for (const measure::Metric& metric : measure::metrics())
        if (!metric.chartName.empty())
            columns[std::string(metric.column)] = {{"name", metric.chartName},
                                                   {"unit", metric.unit},
                                                   {"better", metric.higherIsBetter ? "high" : "low"},
                                                   {"metric", true},
                                                   {"flaw", metric.isFlaw}};
    addOthers(false);
    return columns.dump();
}

std::string documentText(std::string_view name) {
    return fileText(reportsFolder() / name);
}

std::string vegaLicence() {
    const fs::path file = "/usr/share/doc/libjs-vega/copyright";
    // A system without installed documentation gets at least the licence's name.
    return fs::exists(file) ? fileText(file)
                            : "Vega: copyright 2015-2021 UW Interactive Data Lab, BSD-3-Clause licence.";
}

std::string chartSpecifications(const std::vector<std::string>& folders) {
    std::vector<fs::path> specifications;
    for (const std::string& folder : folders)
        for (const auto& entry : fs::directory_iterator(reportsFolder() / "page" / folder))
            if (entry.path().extension() == ".json") specifications.push_back(entry.path());
    std::ranges::sort(specifications);
    std::string all;
    for (const fs::path& file : specifications)
        all += fmt::format("{}\"{}\":{}", all.empty() ? "{" : ",", file.stem().string(), fileText(file));
    return all + "}";
}

std::string chartScript() {
    return joined({"chart_style.js", "chart_data.js", "chart_parts.js", "published_marks.js", "cost_chart.js",
                   "stage_chart.js", "quality_chart.js", "map_chart.js", "charts.js", "words.js"});
}

std::string pageScript() {
    return joined({"elements.js", "markdown.js", "pictures.js", "claims.js", "overview.js", "page_state.js",
                   "page_look.js", "chart_card.js", "head.js", "page.js"});
}

std::string machinesScript() {
    return joined({"chart_style.js", "chart_data.js", "chart_parts.js", "words.js", "machines/machine_charts.js",
                   "elements.js", "page_state.js", "page_look.js", "chart_card.js", "machines/tables.js",
                   "machines/page.js"});
}

std::string vegaScript() {
    std::string script = "const vegaParts = {};\n";
    for (const auto& [name, file] : vegaModules) {
        const fs::path path = vegaFolder() / fmt::format("vega-{}.min.js", file);
        if (!fs::exists(path))
            throw InputError(fmt::format("'{}' is missing; on Debian, install the package libjs-vega", path.string()));
        script += fmt::format("vegaParts['vega-{}'] = function (exports, require, module) {{\n{}\n}};\n", name,
                              fileText(path));
    }
    return script + reportFile("vega.js");
}

}  // namespace dustbench::report
