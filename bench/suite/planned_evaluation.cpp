#include "bench/suite/planned_evaluation.h"

#include <algorithm>
#include <sstream>

#include "bench/results/summary.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::suite {
namespace {

ComparedSide parseSide(const std::string& text, const std::vector<std::string>& methods) {
    std::istringstream words(text);
    ComparedSide side;
    if (!(words >> side.method)) throw InputError("got no method, expected METHOD or METHOD name=value …");
    if (std::ranges::find(methods, side.method) == methods.end())
        throw unknownName("method of this suite", side.method, methods);
    side.label = side.method;
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0)
            throw InputError("got '" + word + "', expected name=value after the method");
        const std::string name = word.substr(0, equals);
        const std::string value =
            results::canonicalParameters(findMethod(side.method), {{name, word.substr(equals + 1)}})[name];
        if (!side.pinned.emplace(name, value).second) throw InputError("got parameter '" + name + "' twice");
        side.label += " " + name + "=" + value;
    }
    return side;
}

ComparedSide readSide(files::TomlReader& table, const std::string& key, const std::vector<std::string>& methods) {
    const std::string text = table.text(key);
    try {
        return parseSide(text, methods);
    } catch (const InputError& error) {
        throw InputError(table.where(key) + "key 'compare." + key + "': " + error.what());
    }
}

/// `table` is an element of the array `ofWhat`.
std::vector<std::string> readColumns(files::TomlReader& table, const std::string& ofWhat) {
    const std::string key = "key '" + ofWhat + ".columns': ";
    const std::vector<std::string> columns = table.texts("columns");
    const std::vector<std::string> known = comparableColumns();
    if (columns.empty()) throw InputError(table.where("columns") + key + "got an empty array, expected names");
    for (auto column = columns.begin(); column != columns.end(); ++column) {
        if (std::ranges::find(known, *column) == known.end())
            throw InputError(table.where("columns") + unknownName("column to compare", *column, known).what());
        if (std::find(columns.begin(), column, *column) != column)
            throw InputError(table.where("columns") + key + "got '" + *column + "' twice");
    }
    return columns;
}

}  // namespace

bool isRate(std::string_view column) {
    return column.starts_with("fps_");
}

std::vector<std::string> comparableColumns() {
    std::vector<std::string> columns;
    for (const std::string& name : results::columnsAfterParameters())
        if (isRate(name) || name.find("_ms_") != std::string::npos) columns.push_back(name);
    return columns;
}

std::vector<std::string> chartColumns() {
    std::vector<std::string> columns = results::columnsAfterParameters();
    std::erase_if(columns, [](const std::string& name) {
        return name.starts_with("FILE_") || name == "metric_reference" || name == "invalid";
    });
    return columns;
}

std::vector<PlannedComparison> readComparisons(files::TomlReader& suite, const std::vector<std::string>& methods) {
    std::vector<PlannedComparison> comparisons;
    for (files::TomlReader& table : suite.tables("compare")) {
        PlannedComparison comparison;
        comparison.where = table.where();
        comparison.of = readSide(table, "of", methods);
        comparison.with = readSide(table, "with", methods);
        comparison.columns = readColumns(table, "compare");
        table.finish();
        comparisons.push_back(std::move(comparison));
    }
    return comparisons;
}

std::vector<PlannedFit> readFits(files::TomlReader& suite) {
    std::vector<PlannedFit> fits;
    for (files::TomlReader& table : suite.tables("fit")) {
        fits.push_back({readColumns(table, "fit"), table.text("against"), table.where()});
        table.finish();
    }
    return fits;
}

}  // namespace dustbench::suite
