#include "bench/report/published.h"

#include <filesystem>

#include "methods/shared/errors.h"
#include "methods/shared/files/csv.h"
#include "methods/shared/files/data_folder.h"

namespace dustbench::bench {

std::map<std::string, std::vector<PublishedPoint>> readPublished(const std::string& paper) {
    const std::filesystem::path file = files::dataFolder() / "papers" / paper / "published.csv";
    std::map<std::string, std::vector<PublishedPoint>> bySuite;
    if (!std::filesystem::exists(file)) return bySuite;
    const auto table = files::CsvTable::parseFile(file);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        PublishedPoint point;
        point.axis = table.cell(row, "axis");
        if (!point.axis.empty()) point.x = table.number(row, "x");
        point.column = table.cell(row, "column");
        point.least = table.number(row, "least");
        point.greatest = table.number(row, "greatest");
        if (point.greatest < point.least)
            throw InputError(table.where(row) + "greatest: got " + table.cell(row, "greatest") +
                             ", allowed: " + table.cell(row, "least") + " and above");
        point.what = table.cell(row, "what");
        bySuite[table.cell(row, "suite")].push_back(point);
    }
    return bySuite;
}

}  // namespace dustbench::bench
