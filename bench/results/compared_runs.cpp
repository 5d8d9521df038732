#include "bench/results/compared_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <sstream>

#include "bench/export/exporter.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"

namespace dustbench::results {
namespace {

template <typename Number>
void readNumber(const StoredRun& run, const std::string& name, const std::string& text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        throw InputError(fmt::format("run '{}': {} is '{}', expected an integer", run.runId, name, text));
}

constexpr std::string_view methodColumn = "method_ms_median";

std::optional<double> frameMs(const StoredRun& run) {
    const auto cell = run.cells.find("frame_ms_median");
    double ms = 0;
    if (run.status != RunStatus::done || cell == run.cells.end()) return std::nullopt;
    const char* const end = cell->second.data() + cell->second.size();
    const auto [at, error] = std::from_chars(cell->second.data(), end, ms);
    if (error != std::errc() || at != end) return std::nullopt;
    return ms;
}

bool isBaseline(const StoredRun& run, const MethodInfo& info) {
    const auto method = run.cells.find("method");
    return method != run.cells.end() && method->second == baselineMethod &&
           std::ranges::all_of(info.parameters.all(), [&](const Parameter& parameter) {
               const auto found = run.parameters.find(parameter.name);
               return found != run.parameters.end() && found->second == parameter.initial;
           });
}

}  // namespace

KeyFields keyFields(const StoredRun& run) {
    const auto key = run.provenance.find("key");
    if (key == run.provenance.end() || key->second.empty())
        throw InputError(fmt::format("run '{}': has no provenance.key, which identifies the configuration", run.runId));
    KeyFields fields;
    std::istringstream lines(key->second);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos)
            throw InputError(
                fmt::format("run '{}': its provenance.key has the line '{}', expected name=value", run.runId, line));
        fields.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    }
    return fields;
}

RunSpec specFromKey(const StoredRun& run) {
    RunSpec spec;
    for (const auto& [name, text] : keyFields(run)) {
        if (name == "method") spec.method = text;
        if (name == "scene") spec.scene = text;
        if (name == "drive") spec.drive = text;
        if (name == "camera_path") spec.cameraPath = text;
        if (name == "dust") spec.dust = text;
        if (name == "dust_columns") spec.dustColumns = text;
        if (name == "dust_on") spec.dustOn = dustPlaces.parse("dust_on", text);
        if (name == "frames") readNumber(run, name, text, spec.frames);
        if (name == "warmup") readNumber(run, name, text, spec.warmup);
        if (name == "size") spec.size = parseSize(text);
        if (name == "seed") readNumber(run, name, text, spec.seed);
        if (name == "threads") readNumber(run, name, text, spec.threads);
        if (name == "sync") spec.sync = syncs.parse("sync", text);
        if (name == "images") readNumber(run, name, text, spec.imagesEvery);
        if (name == "times") spec.timed = text != "0";
        if (name == "repetition") readNumber(run, name, text, spec.repetition);
        if (name.starts_with("p.")) spec.parameters[name.substr(2)] = text;
    }
    return spec;
}

std::span<const std::string_view> machineFields() {
    static constexpr std::array<std::string_view, 7> fields{"cpu",         "cores",       "governor",  "gl_vendor",
                                                            "gl_renderer", "gl_platform", "build_type"};
    return fields;
}

std::span<const std::string_view> circumstanceFields() {
    static constexpr std::array<std::string_view, 9> fields{"version",   "git_commit",  "compiler",
                                                            "flags",     "kernel",      "gl_version",
                                                            "ram_bytes", "quota_cores", "environment"};
    return fields;
}

std::vector<std::string> valuesOf(const StoredRun& run, std::span<const std::string_view> fields) {
    std::vector<std::string> values;
    values.reserve(fields.size());
    for (const std::string_view field : fields) {
        const auto found = run.provenance.find(field);
        values.push_back(found == run.provenance.end() ? std::string() : found->second);
    }
    return values;
}

std::string differingInput(const StoredRun& first, const StoredRun& second) {
    std::map<std::string, std::string> hashes;
    for (const measure::InputHash& input : first.inputs) hashes[input.file] = input.sha256;
    for (const measure::InputHash& input : second.inputs) {
        const auto found = hashes.find(input.file);
        if (found == hashes.end() || found->second != input.sha256) return input.file;
        hashes.erase(found);
    }
    return hashes.empty() ? std::string() : hashes.begin()->first;
}

bool areOneMeasurement(const StoredRun& a, const StoredRun& b) {
    const auto started = a.provenance.find("started_utc");
    if (a.runId != b.runId || started == a.provenance.end() || started->second.empty()) return false;
    const auto same = [](const OutputFile& x, const OutputFile& y) { return x.file == y.file && x.sha256 == y.sha256; };
    const std::vector<OutputFile> none;
    return a.provenance == b.provenance && a.cells == b.cells &&
           std::ranges::equal(a.outputs ? *a.outputs : none, b.outputs ? *b.outputs : none, same);
}

std::vector<FieldDifference> differences(const StoredRun& first, const StoredRun& second,
                                         std::span<const std::string_view> fields) {
    const std::vector<std::string> a = valuesOf(first, fields), b = valuesOf(second, fields);
    std::vector<FieldDifference> list;
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (a[i] != b[i]) list.push_back({std::string(fields[i]), a[i], b[i]});
    return list;
}

const MethodInfo* findBaseline() {
    const auto found = std::ranges::find(methods(), baselineMethod, &MethodInfo::id);
    return found == methods().end() ? nullptr : &*found;
}

std::optional<KeyFields> pairKey(const StoredRun& run) try {
    static const std::set<std::string> leftOut = [] {
        std::set<std::string> names{"method", "images",  "volumes",          "formats",        "resolution",
                                    "region", "metrics", "metric_reference", "metric_pictures"};
        for (const exports::ExporterOption& option : exports::exporterOptions()) names.insert(option.id);
        return names;
    }();
    KeyFields fields = keyFields(run);
    std::erase_if(fields, [](const auto& field) {
        const auto& [name, value] = field;
        return leftOut.contains(name) || (name.starts_with("p.") && !world::worldParameters().find(name.substr(2)));
    });
    return fields;
} catch (const InputError&) {
    return std::nullopt;
}

void addMethodTimes(StoredRuns& runs) {
    const MethodInfo* info = findBaseline();
    std::multimap<KeyFields, const StoredRun*> baselines;
    for (const auto& [id, run] : runs)
        if (info && isBaseline(run, *info) && frameMs(run))
            if (auto key = pairKey(run)) baselines.emplace(std::move(*key), &run);
    for (auto& [id, run] : runs) {
        run.cells.erase(std::string(methodColumn));
        const auto ms = frameMs(run);
        if (!ms || baselines.empty() || isBaseline(run, *info)) continue;
        const auto key = pairKey(run);
        if (!key) continue;
        const auto [begin, end] = baselines.equal_range(*key);
        const auto paired = std::find_if(
            begin, end, [&](const auto& entry) { return differences(run, *entry.second, machineFields()).empty(); });
        if (paired != end) run.cells.emplace(methodColumn, files::csvNumber(*ms - *frameMs(*paired->second)));
    }
}

}  // namespace dustbench::results
