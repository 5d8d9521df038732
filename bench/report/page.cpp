#include "bench/report/page.h"

#include <fmt/format.h>

#include "bench/export/whole_file.h"
#include "bench/report/page_template.h"
#include "bench/report/report_files.h"
#include "bench/report/report_json.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::bench {

std::string citationOf(const Paper& paper) {
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
    writeWhole(file, pageOf(data));
    // A folder of tables alone keeps its claims.csv, with the verdicts from when it was measured.
    if (!data.claims.empty() && !(data.tablesOnly && std::filesystem::exists(folder / "claims.csv")))
        writeWhole(folder / "claims.csv", claimsCsv(data.claims));
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
    writeWhole(file, pageOf(data));
    return file;
}

}  // namespace dustbench::bench
