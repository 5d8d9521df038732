#include "bench/results/stored_run.h"

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <set>

#include "bench/results/compared_runs.h"
#include "bench/results/summary.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::results {
namespace fs = std::filesystem;
namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

/// A value as text for a table; empty for null, arrays and objects.
std::string textOfCell(element value) {
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

/// True for columns of summary.csv that contain numbers; false for unknown columns.
bool isNumeric(std::string_view column) {
    static const std::set<std::string, std::less<>> names = [] {
        const std::vector<std::string>& list = numericColumns();
        std::set<std::string, std::less<>> all{"seed", "repetition", "width", "height", "threads"};
        all.insert(list.begin(), list.end());
        return all;
    }();
    return names.contains(column);
}

/// Truncates reasons and warnings: they are sentences, and a longer text comes from a damaged file.
std::string shortened(std::string text) {
    constexpr std::size_t maximum = 1000;
    if (text.size() <= maximum) return text;
    return fmt::format("{} [{} bytes in all]", text.substr(0, maximum), text.size());
}

template <typename Map>
void readCells(object fields, Map& cells) {
    for (const auto& [name, value] : fields)
        if (!value.is_array() && !value.is_object()) cells[std::string(name)] = textOfCell(value);
}

std::string textOf(element value) {
    return std::string(std::string_view(value));
}

OutputFile outputOf(element value) {
    OutputFile output{textOf(value["file"]), std::uint64_t(value["bytes"]), textOfCell(value["sha256"])};
    if (!isWithin(output.file))
        throw InputError(
            fmt::format("outputs: got the file '{}', expected one below the run's folder", output.file.substr(0, 200)));
    return output;
}

std::optional<std::vector<OutputFile>> readOutputs(object json) {
    element list;
    simdjson::error_code missing{};
    json["outputs"].tie(list, missing);
    if (missing || list.is_null()) return std::nullopt;
    std::vector<OutputFile> outputs;
    for (const element output : list.get_array()) outputs.push_back(outputOf(output));
    return outputs;
}

}  // namespace

std::string whyInvalid(const StoredRun& run) {
    const auto found = run.cells.find("invalid");
    return found == run.cells.end() ? std::string() : found->second;
}

std::string saysInvalid(const std::vector<const StoredRun*>& runs) {
    std::map<std::string, std::size_t> reasons;
    std::size_t count = 0;
    for (const StoredRun* run : runs)
        if (std::string why = whyInvalid(*run); !why.empty()) {
            ++reasons[shortened(std::move(why))];
            ++count;
        }
    if (count == 0) return "";
    const auto most = std::ranges::max_element(reasons, {}, [](const auto& entry) { return entry.second; });
    return fmt::format("{} of {} {} invalid and left out of claims, fits and verdicts: {}{}", count, runs.size(),
                       runs.size() == 1 ? "run is"
                       : count == 1     ? "runs is"
                                        : "runs are",
                       most->first,
                       reasons.size() == 1   ? std::string()
                       : reasons.size() == 2 ? std::string(" (and another reason)")
                                             : fmt::format(" (and {} other reasons)", reasons.size() - 1));
}

StoredRun readRunFile(const std::filesystem::path& file) {
    thread_local simdjson::dom::parser parser;  // reuses its memory
    const simdjson::padded_string text(files::wholeText(file, "a run.json"));
    try {
        const object json = parser.parse(text);
        StoredRun run;
        run.runId = textOf(json["run_id"]);
        run.reason = shortened(textOf(json["reason"]));
        run.status = runStatuses.parse("status", textOf(json["status"]));
        readCells(json["parameters"], run.parameters);
        readCells(json["summary"], run.cells);
        for (const element warning : json["warnings"].get_array()) run.warnings.push_back(shortened(textOf(warning)));
        run.stateHash = textOfCell(json["state_hash"]);
        run.methodHash = textOfCell(json["method_hash"]);
        readCells(json["provenance"], run.provenance);
        if (run.status == RunStatus::done && !run.cells.contains("dust_on")) {
            // An older run: its provenance has the place, or it is from the time before there was dust on the GPU.
            const auto place = run.provenance.find("dust_on");
            run.cells["dust_on"] = place == run.provenance.end() ? "cpu" : place->second;
        }
        for (const element input : json["provenance"]["inputs"].get_array())
            run.inputs.push_back({textOf(input["file"]), textOf(input["sha256"])});
        if (array searches; json["provenance"]["searches"].get(searches) == simdjson::SUCCESS)
            for (const element search : searches)
                run.searches.push_back({textOf(search["path"]), textOf(search["names_sha256"])});
        if (array ignored; json["provenance"]["ignored"].get(ignored) == simdjson::SUCCESS)
            for (const element each : ignored) {
                measure::IgnoredParts& parts =
                    run.ignored.emplace_back(measure::IgnoredParts{textOf(each["file"]), {}});
                for (const element part : each["parts"].get_array()) parts.parts.push_back(shortened(textOf(part)));
            }
        run.outputs = readOutputs(json);
        requireSoundCells(run);
        return run;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        const auto* const ofReader = dynamic_cast<const simdjson::simdjson_error*>(&error);
        if (ofReader && ofReader->error() == simdjson::MEMALLOC) throw std::bad_alloc();
        throw InputError(file.string() + ": is not a run.json of dustbench: " + error.what());
    }
}

void requireSoundCells(const StoredRun& run) {
    for (const auto& [column, text] : run.cells)
        if (isNumeric(column) && !text.empty() && !files::numberOf(text))
            throw InputError(fmt::format("summary.{}: got '{}', expected a number", column, text.substr(0, 40)));
    const auto repetition = run.cells.find("repetition");
    if (repetition == run.cells.end() || repetition->second.empty()) return;
    const double number = *files::numberOf(repetition->second);
    if (number != std::floor(number) || number < 1 || number > files::limits::repetitions)
        throw InputError(fmt::format("summary.repetition: got '{}', allowed: 1..{} (limit of repetitions)",
                                     repetition->second.substr(0, 40), files::limits::repetitions));
}

StoredRun readRunFolder(const fs::path& folder) {
    StoredRun run = readRunFile(folder / "run.json");
    if (run.runId != folder.filename())
        throw InputError(fmt::format("'{}': contains the run '{}', expected the run that the folder is named after",
                                     (folder / "run.json").string(), run.runId));
    if (!run.outputs) return run;
    if (const std::string why = whyAltered(*run.outputs, folder); !why.empty())
        throw InputError(fmt::format("'{}': {}", folder.string(), why));
    return run;
}

std::string saysNothingOfOutputs(const StoredRuns& runs) {
    const auto count = std::ranges::count_if(
        runs, [](const auto& entry) { return entry.second.status == RunStatus::done && !entry.second.outputs; });
    if (count == 0) return "";
    return fmt::format(
        "{} of {} runs are from an older build that did not record the SHA-256 of their files, so changes to "
        "these files cannot be detected",
        count, runs.size());
}

StoredRuns readStoredRuns(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder / "runs", error))
        throw InputError(
            fmt::format("'{}': is not a results folder, expected it to contain a folder 'runs'", folder.string()));
    StoredRuns runs;
    fs::directory_iterator entry(folder / "runs", error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (name.starts_with('.') || entry->is_regular_file(error)) continue;  // a stray file is not a run
        runs.emplace(name, readRunFolder(entry->path()));
    }
    if (error) throw InputError(fmt::format("'{}': cannot be read: {}", folder.string(), error.message()));
    addMethodTimes(runs);
    return runs;
}

}  // namespace dustbench::results
