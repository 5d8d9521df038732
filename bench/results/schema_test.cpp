// Checks reports/SCHEMA.md against the headers of the files that the program writes, in both directions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "bench/export/exporter.h"
#include "bench/measure/image/metric.h"
#include "bench/reference/judge/judgement.h"
#include "bench/results/method_facts.h"
#include "bench/results/summary.h"
#include "methods/kit/files/csv.h"
#include "source_folder.h"

namespace dustbench::results {
namespace {

using Names = std::vector<std::string>;

struct Row {
    Names cells;
};

/// The rows of the table below `## section`, without its header.
std::vector<Row> tableOf(const std::string& section) {
    std::ifstream file(std::string(DUSTBENCH_SOURCE_DIR) + "/reports/SCHEMA.md");
    std::vector<Row> rows;
    bool inside = false;
    int head = 2;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) inside = line == "## " + section;
        if (!inside || !line.starts_with("|") || head-- > 0) continue;
        Row row;
        std::size_t at = 1;
        for (std::size_t end; (end = line.find('|', at)) != std::string::npos; at = end + 1)
            row.cells.push_back(line.substr(at, end - at));
        rows.push_back(row);
    }
    return rows;
}

/// The columns that a row describes: `a`, `b` and `c` … `f`, where the last means all columns from c to f; `<stage>`
/// matches any.
Names namesIn(const std::string& cell, const Names& header) {
    Names names;
    const std::regex name("(`([^`]+)`)|…");
    bool range = false;
    for (std::sregex_iterator at(cell.begin(), cell.end(), name); at != std::sregex_iterator(); ++at) {
        const std::string found = (*at)[2];
        if (found.empty()) {
            range = true;
        } else if (found == "<stage>_ms_median") {
            for (const std::string_view stage : stageNames) names.push_back(std::string(stage) + "_ms_median");
        } else if (range) {
            auto from = std::ranges::find(header, names.back());
            const auto to = std::ranges::find(header, found);
            while (from != header.end() && from != to) names.push_back(*++from);
            range = false;
        } else {
            names.push_back(found);
        }
    }
    return names;
}

/// Every column has a unit and a definition, and nothing else is defined.
void expectDefined(const std::string& section, const Names& header, std::size_t definitionCell = 2) {
    std::set<std::string> defined;
    for (const Row& row : tableOf(section)) {
        ASSERT_EQ(row.cells.size(), definitionCell + 1) << section << ": " << row.cells.front();
        EXPECT_GT(row.cells[definitionCell].size(), 4u) << section << ": " << row.cells.front() << " has no definition";
        for (const std::string& name : namesIn(row.cells[0], header))
            EXPECT_TRUE(defined.insert(name).second) << section << ": " << name << " is defined twice";
    }
    EXPECT_EQ(defined, std::set<std::string>(header.begin(), header.end())) << section;
}

Names headerOf(const std::string& csv) {
    return files::CsvTable::parseText(csv, "file.csv").header();
}

TEST(Schema, DefinesEveryColumnOfEveryTable) {
    expectDefined("frames.csv", headerOf(framesCsv({})));
    expectDefined("stages.csv", headerOf(stagesCsv({})));
    const auto isMetric = [](const std::string& name) {
        return std::ranges::find(measure::metrics(), name, &measure::Metric::column) != measure::metrics().end();
    };
    Names ofFrames = headerOf(reference::metricsCsv(reference::RunMetrics()));
    std::erase_if(ofFrames, [&](const std::string& name) { return isMetric(name) && name != "popping"; });
    expectDefined("metrics.csv", ofFrames);
    Names summary = columnsBeforeParameters();
    summary.push_back("p.<name>");
    summary.insert(summary.end(), columnsAfterParameters().begin(), columnsAfterParameters().end());
    std::erase_if(summary, [&](const std::string& name) {
        return isMetric(name) ||
               std::ranges::any_of(methodFacts(), [&](const MethodFact& fact) { return fact.info.name == name; });
    });
    expectDefined("summary.csv", summary);
}

std::string overRunText(measure::OverRun overRun) {
    switch (overRun) {
        case measure::OverRun::mean:
            return "mean over the compared frames in which it is defined";
        case measure::OverRun::all:
            return "1 if it is 1 in all compared frames";
        case measure::OverRun::pairs:
        case measure::OverRun::whole:
            return "over the pairs of consecutive frames among the last 31";
    }
    return {};
}

/// Compares the rows below a table's head with those made from the declarations, or writes these into the document if
/// DUSTBENCH_DOCUMENTS=write.
void expectRows(const std::string& document, const std::string& head, const std::string& rows) {
    const std::string file = std::string(DUSTBENCH_SOURCE_DIR) + "/reports/" + document;
    std::ifstream stream(file);
    std::string text(std::istreambuf_iterator<char>(stream), {});
    std::size_t begin = text.find("\n" + head + "\n");
    ASSERT_NE(begin, std::string::npos) << document << " has no table " << head;
    begin = text.find('\n', begin + head.size() + 2) + 1;  // after the line of dashes
    const std::size_t end = text.find("\n\n", begin - 1) + 1;
    if (text.substr(begin, end - begin) == rows) return;
    const char* const wish = std::getenv("DUSTBENCH_DOCUMENTS");
    if (wish && std::string_view(wish) == "write") {
        std::ofstream(file) << text.replace(begin, end - begin, rows);
    } else {
        ADD_FAILURE() << document << ": the rows below\n"
                      << head << "\ndiffer from the declarations; `make documents` writes them again";
    }
}

std::string rowOf(std::initializer_list<std::string_view> cells) {
    std::string row = "|";
    for (const std::string_view cell : cells) row += cell.empty() ? " |" : fmt::format(" {} |", cell);
    return row + "\n";
}

TEST(MetricDocuments, HaveARowForEachMetricAsItIsDeclared) {
    const auto quoted = [](const measure::Metric& metric) { return fmt::format("`{}`", metric.column); };
    std::string definitions, columns;
    for (const measure::Metric& metric : measure::metrics()) {
        EXPECT_EQ(std::ranges::count(columnsAfterParameters(), metric.column), 1) << metric.column << ": see its round";
        definitions += rowOf({quoted(metric), metric.definition, metric.range, metric.perfect, metric.unit,
                              measure::referenceOf(metric), metric.emptyWhen, metric.source});
        columns += rowOf({quoted(metric), metric.unit, metric.title, overRunText(metric.overRun)});
    }
    expectRows("METRICS.md", "| Id | Definition | Range | Perfect | Unit | Reference | Empty when | Source |",
               definitions);
    expectRows("SCHEMA.md", "| column | unit | definition | of a run |", columns);
}

TEST(ExporterDocuments, HaveARowForEachFormatAsItIsDeclared) {
    std::string rows;
    for (const exports::Exporter& exporter : exports::exporters())
        rows += rowOf({fmt::format("`{}`", exporter.id), exporter.contents, exporter.programs});
    expectRows("guide/paraview-blender.md", "| Format | Contents | For |", rows);
}

/// Rows without a fact belong to methods that this build excludes.
TEST(Schema, ShowsEveryFactAsItsMethodsDeclareIt) {
    std::map<std::string, std::string> rows;
    for (const Row& row : tableOf("Facts of methods")) {
        ASSERT_EQ(row.cells.size(), 4u) << row.cells.front();
        rows[row.cells[0]] = row.cells[1] + "|" + row.cells[2] + "|" + row.cells[3];
    }
    for (const auto& [info, methods] : methodFacts()) {
        std::string names;
        for (const std::string& method : methods) names += (names.empty() ? "" : ", ") + method;
        EXPECT_EQ(rows[" `" + info.name + "` "], " " + info.unit + " | " + names + " | " + info.meaning + " ");
    }
}

TEST(Schema, DefinesEveryFieldOfARun) {
    const auto run = nlohmann::ordered_json::parse(toJson(RunRecord()));
    Names fields;
    for (const auto& [name, value] : run.items()) fields.push_back(name);
    expectDefined("run.json", fields, 1);

    std::ifstream file(std::string(DUSTBENCH_SOURCE_DIR) + "/reports/SCHEMA.md");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::size_t begin = text.find("\n`provenance`: ");
    ASSERT_NE(begin, std::string::npos);
    const std::string paragraph = text.substr(begin, text.find("\n\n", begin + 1) - begin);
    for (const auto& [name, value] : run.at("provenance").items())
        EXPECT_NE(paragraph.find("`" + name + "`"), std::string::npos) << "provenance: " << name;
}

}  // namespace
}  // namespace dustbench::results
