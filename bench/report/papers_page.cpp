#include "bench/report/papers_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "bench/export/whole_file.h"
#include "bench/measure/provenance.h"
#include "bench/report/page.h"
#include "bench/report/page_template.h"
#include "bench/report/report_files.h"

namespace dustbench::bench {
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
            chips += fmt::format("<span class=\"verdict {0}\">{1} {0}</span> ",
                                 verdictName(static_cast<ClaimVerdict>(index)), line.verdicts.at(index));
    return chips;
}

std::string rowOf(const PaperLine& line) {
    return fmt::format(
        "<tr><td class=\"wide\"><a href=\"{}/index.html\">{}</a><div class=\"muted\">{}</div></td><td>{}</td>"
        "<td class=\"number\">{} of {}</td><td class=\"number\">{}</td><td>{}</td><td>{}</td></tr>\n",
        escaped(line.folder), escaped(line.citation), escaped(line.venue), verdictChips(line), line.runsDone, line.runs,
        line.runsWithWarnings, line.form, escaped(fmt::format("{}", fmt::join(line.machines, "; "))));
}

}  // namespace

PaperLine lineOf(const ReportData& data, const Paper& paper, const std::string& folder) {
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
    for (const EvaluatedClaim& claim : data.claims)
        if (claim.paper == paper.id) ++line.verdicts.at(static_cast<std::size_t>(claim.result.verdict));
    return line;
}

std::string papersPage(const std::vector<PaperLine>& lines) {
    std::string rows;
    for (const PaperLine& line : lines) rows += rowOf(line);
    return filled(reportFile("papers.html"), {{"style", reportFile("page.css")},
                                              {"rows", rows},
                                              {"count", std::to_string(lines.size())},
                                              {"version", escaped(buildFacts().version)}});
}

std::filesystem::path writePapersPage(const std::filesystem::path& folder, const std::vector<PaperLine>& lines) {
    requireOwnPage(folder);
    writeWhole(folder / "index.html", papersPage(lines));
    return folder / "index.html";
}

}  // namespace dustbench::bench
