#include "bench/report/page.h"

#include <fmt/format.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <map>

#include "bench/export/whole_file.h"
#include "bench/report/report_files.h"
#include "bench/report/report_json.h"

namespace dustbench::bench {
namespace {

/// Identifies our pages; part of the template.
constexpr std::string_view mark = "<meta name=\"generator\" content=\"dustbench\">";

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char letter : text) {
        if (letter == '&')
            safe += "&amp;";
        else if (letter == '<')
            safe += "&lt;";
        else
            safe += letter;
    }
    return safe;
}

/// Replaces `{{name}}` in a single pass, so that inserted text is not expanded.
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

}  // namespace

std::string pageOf(const ReportData& data) {
    return filled(reportFile("page.html"), {{"title", escaped(data.folder)},
                                            {"style", reportFile("page.css")},
                                            {"vega", vegaScript()},
                                            {"columns", reportFile("columns.json")},
                                            {"charts", chartSpecifications()},
                                            {"data", reportJson(data)},
                                            {"schema", escaped(schemaText())},
                                            {"licence", escaped(vegaLicence())},
                                            {"chart-script", chartScript()},
                                            {"page-script", pageScript()}});
}

std::filesystem::path writePage(const std::filesystem::path& folder, const ReportData& data) {
    std::filesystem::path file = folder / "index.html";
    if (std::filesystem::exists(file)) {
        std::ifstream stream(file, std::ios::binary);
        const std::string there(std::istreambuf_iterator<char>(stream), {});
        if (there.find(mark) == std::string::npos)
            throw InputError(
                fmt::format("'{}': exists and was not written by dustbench; move it away first", file.string()));
    }
    writeWhole(file, pageOf(data));
    if (!data.claims.empty()) writeWhole(folder / "claims.csv", claimsCsv(data.claims));
    return file;
}

}  // namespace dustbench::bench
