#include "bench/report/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "bench/export/whole_file.h"
#include "bench/measure/provenance.h"
#include "bench/report/report_files.h"
#include "bench/report/report_json.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::report {
namespace {

using Conditions = std::map<std::string, std::string, std::less<>>;

std::string fieldOf(const Conditions& machine, std::string_view name) {
    const auto found = machine.find(name);
    return found == machine.end() || found->second.empty() ? fmt::format("unknown {}", name) : found->second;
}

std::string machineText(const Conditions& machine) {
    return fmt::format("{}, {} cores, {}", fieldOf(machine, "cpu"), fieldOf(machine, "cores"),
                       fieldOf(machine, "gl_renderer"));
}

std::string verdictChips(const PaperLine& line) {
    std::string chips;
    for (std::size_t index = 0; index < line.verdicts.size(); ++index)
        if (line.verdicts.at(index) > 0)
            chips +=
                fmt::format("<span class=\"verdict {0}\">{1} {0}</span> ",
                            claims::verdictName(static_cast<claims::ClaimVerdict>(index)), line.verdicts.at(index));
    return chips;
}

std::string rowOf(const PaperLine& line) {
    return fmt::format(
        "<tr><td class=\"wide\"><a href=\"{}/index.html\">{}</a><div class=\"muted\">{}</div></td><td>{}</td>"
        "<td class=\"number\">{} of {}</td><td class=\"number\">{}</td><td>{}</td><td>{}</td></tr>\n",
        escaped(line.folder), escaped(line.citation), escaped(line.venue), verdictChips(line), line.runsDone, line.runs,
        line.runsWithWarnings, line.form, escaped(fmt::format("{}", fmt::join(line.machines, "; "))));
}

/// Identifies our pages; part of the templates.
constexpr std::string_view mark = "<meta name=\"generator\" content=\"dustbench\">";

}  // namespace

std::string citationOf(const suite::Paper& paper) {
    return fmt::format("{}{}: {}", paper.authors, paper.year != 0 ? fmt::format(" ({})", paper.year) : "", paper.title);
}

std::string pageOf(const ReportData& data) {
    const std::string title = data.papers.size() == 1 ? citationOf(data.papers.front()) : "dustbench: " + data.folder;
    return filled(reportFile("page.html"), {{"title", escaped(title)},
                                            {"style", reportFile("page.css")},
                                            {"vega", vegaScript()},
                                            {"columns", reportColumns()},
                                            {"charts", chartSpecifications()},
                                            {"data", reportJson(data)},
                                            {"schema", escaped(documentText("SCHEMA.md"))},
                                            {"metrics", escaped(documentText("METRICS.md"))},
                                            {"licence", escaped(vegaLicence())},
                                            {"chart-script", chartScript()},
                                            {"page-script", pageScript()}});
}

std::filesystem::path writePage(const std::filesystem::path& folder, const ReportData& data) {
    requireOwnPage(folder);
    const std::filesystem::path file = folder / "index.html";
    exports::writeWhole(file, pageOf(data));
    // A folder of tables alone keeps its claims.csv, with the verdicts from when it was measured.
    if (!data.claims.empty() && !(data.tablesOnly && std::filesystem::exists(folder / "claims.csv")))
        exports::writeWhole(folder / "claims.csv", claims::claimsCsv(data.claims));
    return file;
}

std::filesystem::path writePageTo(const std::filesystem::path& out, const std::filesystem::path& folder,
                                  ReportData data) {
    namespace fs = std::filesystem;
    const fs::path file = out.extension() == ".html" ? out : out / "index.html";
    const fs::path place = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code error;
    fs::create_directories(place, error);
    if (error) files::failWriting(place.string(), error.value());
    requireOwnPage(place, file.filename().string());
    const std::string root = fs::relative(folder, place).generic_string();
    data.root = root == "." ? "" : root + "/";
    exports::writeWhole(file, pageOf(data));
    return file;
}

PaperLine lineOf(const ReportData& data, const suite::Paper& paper, const std::string& folder) {
    PaperLine line;
    line.citation = citationOf(paper);
    line.venue = paper.venue;
    line.folder = folder;
    line.runs = data.runs.size();
    line.runsDone = data.runs.size() - data.notDone.size();
    std::set<std::string> warned;
    for (const RunWarnings& kind : data.warnings) warned.insert(kind.runs.begin(), kind.runs.end());
    line.runsWithWarnings = warned.size();
    const bool quick = std::ranges::any_of(
        data.groups, [](const RunGroup& group) { return !group.suite.empty() && group.id != group.suite; });
    line.form = quick ? "quick" : "full";
    for (const auto& machine : data.machines) line.machines.push_back(machineText(machine));
    for (const claims::EvaluatedClaim& claim : data.claims)
        if (claim.paper == paper.id) ++line.verdicts.at(static_cast<std::size_t>(claim.result.verdict));
    return line;
}

std::string papersPage(const std::vector<PaperLine>& lines) {
    std::string rows;
    for (const PaperLine& line : lines) rows += rowOf(line);
    return filled(reportFile("papers.html"), {{"style", reportFile("page.css")},
                                              {"rows", rows},
                                              {"count", std::to_string(lines.size())},
                                              {"version", escaped(measure::buildFacts().version)}});
}

std::filesystem::path writePapersPage(const std::filesystem::path& folder, const std::vector<PaperLine>& lines) {
    requireOwnPage(folder);
    exports::writeWhole(folder / "index.html", papersPage(lines));
    return folder / "index.html";
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char letter : text) {
        if (letter == '&')
            safe += "&amp;";
        else if (letter == '<')
            safe += "&lt;";
        else if (letter == '"')
            safe += "&quot;";
        else
            safe += letter;
    }
    return safe;
}

std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& parts) {
    std::string result;
    for (std::size_t at = 0;;) {
        const std::size_t open = text.find("{{", at);
        const std::size_t close = open == std::string_view::npos ? open : text.find("}}", open);
        if (close == std::string_view::npos) return result.append(text.substr(at));
        result.append(text.substr(at, open - at));
        result.append(parts.at(std::string(text.substr(open + 2, close - open - 2))));
        at = close + 2;
    }
}

void requireOwnPage(const std::filesystem::path& folder, std::string_view name) {
    const std::filesystem::path file = folder / name;
    std::error_code none;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, none))) return;
    const std::string there = files::wholeText(file, "a dustbench report to replace", files::limits::geometryBytes);
    if (there.find(mark) == std::string::npos)
        throw InputError(
            fmt::format("'{}' exists and was not written by dustbench; move it away first", file.string()));
}

}  // namespace dustbench::report
