#include "bench/report/machines/machine_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/export/whole_file.h"
#include "bench/report/page_template.h"
#include "bench/report/report_files.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::bench {
namespace {

namespace fs = std::filesystem;

std::string titleOf(const MachineSet& set) {
    return fmt::format("dustbench: {}", fmt::join(set.labels, ", "));
}

void requireOtherFolder(const fs::path& file, const MachineSet& set) {
    for (const ReportData& data : set.folders) {
        std::error_code none;
        if (fs::equivalent(file.parent_path(), data.folder, none) && file.filename() == "index.html")
            throw InputError(
                fmt::format("--out: got '{}', where that folder's own report is; expected another "
                            "folder or file",
                            data.folder));
    }
}

}  // namespace

MachineComparison comparisonOf(MachineSet set) {
    MachineComparison comparison{
        .set = std::move(set), .cells = {}, .remarks = {}, .hardware = {}, .experiments = {}, .claims = {}};
    comparison.cells = cellsOf(comparison.set);
    comparison.remarks = remarksOn(comparison.set, comparison.cells);
    comparison.hardware = hardwareTable(comparison.set);
    comparison.experiments = compareMachines(comparison.set, comparison.cells);
    comparison.claims = sharedClaims(comparison.set);
    return comparison;
}

std::string machinesPage(const MachineComparison& comparison) {
    return filled(reportFile("machines/page.html"), {{"title", escaped(titleOf(comparison.set))},
                                                     {"style", reportFile("page.css")},
                                                     {"machines-style", reportFile("machines/page.css")},
                                                     {"vega", vegaScript()},
                                                     {"columns", reportColumns()},
                                                     {"charts", chartSpecifications({"charts", "machines/charts"})},
                                                     {"data", machinesJson(comparison)},
                                                     {"licence", escaped(vegaLicence())},
                                                     {"script", machinesScript()}});
}

fs::path writeMachinesPage(const fs::path& out, const MachineComparison& comparison) {
    const fs::path file = out.extension() == ".html" ? out : out / "index.html";
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    requireOtherFolder(folder / file.filename(), comparison.set);
    requireOwnPage(folder, file.filename().string());
    const std::string page = machinesPage(comparison);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) files::failWriting(folder.string(), error.value());
    writeWhole(file, page);
    return file;
}

}  // namespace dustbench::bench
