#include "bench/report/page.h"

#include <fmt/format.h>

#include "bench/export/whole_file.h"
#include "bench/report/page_template.h"
#include "bench/report/report_files.h"
#include "bench/report/report_json.h"

namespace dustbench::bench {

std::string citationOf(const Paper& paper) {
    return fmt::format("{}{}: {}", paper.authors, paper.year != 0 ? fmt::format(" ({})", paper.year) : "", paper.title);
}

std::string pageOf(const ReportData& data) {
    const std::string title = data.papers.size() == 1 ? citationOf(data.papers.front()) : "dustbench: " + data.folder;
    return filled(reportFile("page.html"), {{"title", escaped(title)},
                                            {"style", reportFile("page.css")},
                                            {"vega", vegaScript()},
                                            {"columns", reportFile("columns.json")},
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
    writeWhole(file, pageOf(data));
    if (!data.claims.empty()) writeWhole(folder / "claims.csv", claimsCsv(data.claims));
    return file;
}

}  // namespace dustbench::bench
