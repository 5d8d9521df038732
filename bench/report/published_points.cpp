#include "bench/report/published_points.h"

#include <filesystem>

#include "bench/suite/paper.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

std::map<std::string, std::vector<PublishedPoint>> readPublished(const std::string& paper) {
    const std::filesystem::path file = paperFile(paper, "published.csv");
    std::map<std::string, std::vector<PublishedPoint>> bySuite;
    if (file.empty()) return bySuite;
    const auto table = files::CsvTable::parseFile(file);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        PublishedPoint point;
        point.axis = table.cell(row, "axis");
        if (!point.axis.empty()) point.x = table.number(row, "x");
        point.column = table.cell(row, "column");
        point.minimum = table.number(row, "min");
        point.maximum = table.number(row, "max");
        if (point.maximum < point.minimum)
            throw InputError(table.where(row) + "max: got " + table.cell(row, "max") +
                             ", allowed: " + table.cell(row, "min") + " and above");
        point.what = table.cell(row, "what");
        bySuite[table.cell(row, "suite")].push_back(point);
    }
    return bySuite;
}

}  // namespace dustbench::bench
