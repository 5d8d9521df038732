#include "bench/results/stored_run.h"

#include <simdjson.h>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

using simdjson::dom::element;
using simdjson::dom::object;

/// Text of a value in a table; empty for null, arrays and objects.
std::string cellText(element value) {
    switch (value.type()) {
        case simdjson::dom::element_type::STRING:
            return std::string(std::string_view(value));
        case simdjson::dom::element_type::DOUBLE:
            return files::csvNumber(double(value));
        case simdjson::dom::element_type::INT64:
        case simdjson::dom::element_type::UINT64:
        case simdjson::dom::element_type::BOOL:
            return simdjson::minify(value);
        default:
            return {};
    }
}

template <typename Map>
void readCells(object fields, Map& cells) {
    for (const auto& [name, value] : fields)
        if (!value.is_array() && !value.is_object()) cells[std::string(name)] = cellText(value);
}

std::string textOf(element value) {
    return std::string(std::string_view(value));
}

}  // namespace

StoredRun readRunFile(const std::filesystem::path& file) {
    thread_local simdjson::dom::parser parser;  // reuses its memory
    try {
        const object json = parser.load(file.string());
        StoredRun run;
        run.runId = textOf(json["run_id"]);
        run.reason = textOf(json["reason"]);
        run.status = runStatuses.parse("status", textOf(json["status"]));
        readCells(json["parameters"], run.parameters);
        readCells(json["summary"], run.cells);
        for (const element warning : json["warnings"].get_array()) run.warnings.push_back(textOf(warning));
        run.stateHash = cellText(json["state_hash"]);
        run.methodHash = cellText(json["method_hash"]);
        readCells(json["provenance"], run.provenance);
        for (const element input : json["provenance"]["inputs"].get_array())
            run.inputs.push_back({textOf(input["file"]), textOf(input["sha256"])});
        return run;
    } catch (const std::exception& error) {
        throw InputError(file.string() + ": is no run.json of dustbench: " + error.what());
    }
}

}  // namespace dustbench::bench
