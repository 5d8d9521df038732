#include "bench/results/run_record.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/export/exporter.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::results {
namespace {

using Json = nlohmann::ordered_json;

/// Canonical text of numbers becomes a number, everything else stays text.
Json typed(const std::string& text) {
    const char* const end = text.data() + text.size();
    std::int64_t whole = 0;
    if (const auto [at, error] = std::from_chars(text.data(), end, whole); error == std::errc() && at == end)
        return whole;
    double number = 0;
    if (const auto [at, error] = std::from_chars(text.data(), end, number);
        error == std::errc() && at == end && std::isfinite(number))
        return number;
    return text;
}

Json toValue(const Value& value) {
    return std::visit(
        [](const auto& held) -> Json {
            using Held = std::decay_t<decltype(held)>;
            if constexpr (std::is_same_v<Held, std::monostate>)
                return nullptr;
            else if constexpr (std::is_same_v<Held, double>)
                return std::isfinite(held) ? Json(held) : Json(nullptr);
            else
                return held;
        },
        value);
}

std::string cellText(const Json& value) {
    if (value.is_null()) return {};
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return files::csvNumber(value.get<double>());
    return value.dump();
}

Json columnsObject(const Columns& columns) {
    Json object = Json::object();
    for (const auto& [name, value] : columns) object[name] = toValue(value);
    return object;
}

Json parametersObject(const ParameterTexts& parameters) {
    Json object = Json::object();
    for (const auto& [name, text] : parameters) object[name] = typed(text);
    return object;
}

Json provenanceObject(const measure::Provenance& provenance) {
    Json inputs = Json::array();
    for (const measure::InputHash& input : provenance.inputs)
        inputs.push_back({{"file", input.file}, {"sha256", input.sha256}});
    Json searches = Json::array();
    for (const measure::InputHash& search : provenance.searches)
        searches.push_back({{"path", search.file}, {"names_sha256", search.sha256}});
    Json ignored = Json::array();
    for (const measure::IgnoredParts& each : provenance.ignored)
        ignored.push_back({{"file", each.file}, {"parts", each.parts}});
    const measure::BuildFacts& build = provenance.build;
    const measure::Machine& machine = provenance.machine;
    return {
        {"argv", provenance.argv},
        {"started_utc", provenance.startedUtc},
        {"version", build.version},
        {"git_commit", build.gitCommit},
        {"git_dirty", build.gitDirty},
        {"compiler", build.compiler},
        {"flags", build.flags},
        {"build_type", build.buildType},
        {"build_id", build.buildId},
        {"cpu", machine.cpu},
        {"governor", machine.governor},
        {"cores", machine.cores},
        {"ram_bytes", machine.ramBytes},
        {"kernel", machine.kernel},
        {"load_average", machine.loadAverage},
        {"virtual_machine", machine.virtualMachine},
        {"stolen_share", machine.stolenShare},
        {"quota_cores", machine.quotaCores},
        {"environment", provenance.environment},
        {"gl_vendor", provenance.device.vendor},
        {"gl_renderer", provenance.device.renderer},
        {"gl_version", provenance.device.version},
        {"gl_platform", provenance.device.platform},
        {"adapter", provenance.device.adapter},
        {"adapter_index", provenance.device.adapterIndex < 0 ? Json(nullptr) : Json(provenance.device.adapterIndex)},
        {"adapter_why", provenance.device.adapterWhy},
        {"dust_on", provenance.dustOn.place},
        {"dust_on_why", provenance.dustOn.why},
        {"gpu_timers", provenance.gpuTimersTrusted},
        {"clock_reading_ns", provenance.clock.readingNs},
        {"clock_stage_ns", provenance.clock.stageNs},
        {"inputs", inputs},
        {"searches", searches},
        {"ignored", ignored}};
}

Json outputsArray(const std::optional<std::vector<OutputFile>>& outputs) {
    if (!outputs) return nullptr;
    Json list = Json::array();
    for (const OutputFile& output : *outputs)
        list.push_back({{"file", output.file},
                        {"bytes", output.bytes},
                        {"sha256", output.sha256.empty() ? Json(nullptr) : Json(output.sha256)}});
    return list;
}

Json volumesObject(const std::optional<exports::VolumeSettings>& volumes) {
    if (!volumes) return nullptr;
    Json object = {{"frames", volumes->frames.text()},
                   {"formats", exports::formatsText(volumes->formats)},
                   {"resolution", volumes->resolution},
                   {"region", volumes->region ? Json(exports::regionText(*volumes->region)) : Json(nullptr)}};
    for (const auto& [id, word] : volumes->namedOptions()) object[id] = word;
    return object;
}

std::optional<exports::VolumeSettings> readVolumes(const Json& json) {
    if (json.is_null()) return std::nullopt;
    exports::VolumeSettings volumes;
    volumes.frames = exports::parseFrameRange("volumes", json.at("frames").get<std::string>());
    volumes.formats = exports::parseFormats(json.at("formats").get<std::string>());
    volumes.resolution = json.at("resolution").get<int>();
    if (!json.at("region").is_null()) volumes.region = exports::parseRegion(json.at("region").get<std::string>());
    for (const exports::ExporterOption& option : exports::exporterOptions())
        if (json.contains(option.id)) volumes.setOption(option.id, json.at(option.id).get<std::string>());
    return volumes;
}

Json metricPlanObject(const std::optional<reference::MetricPlan>& metricPlan) {
    if (!metricPlan) return nullptr;
    return {{"frames", metricPlan->moments ? Json(metricPlan->moments->text()) : Json(nullptr)},
            {"finer", metricPlan->finer},
            {"pictures", metricPlan->keepsPictures}};
}

std::optional<reference::MetricPlan> readMetricPlan(const Json& json) {
    if (json.is_null()) return std::nullopt;
    reference::MetricPlan metricPlan;
    if (!json.at("frames").is_null())
        metricPlan.moments = exports::parseFrameRange("metrics", json.at("frames").get<std::string>());
    for (const auto& [name, value] : json.at("finer").items()) metricPlan.finer[name] = value.get<std::string>();
    metricPlan.keepsPictures = json.at("pictures").get<bool>();
    return metricPlan;
}

/// The specification, as specFromJson reads it.
Json specObject(const RunSpec& spec) {
    return {{"method", spec.method},
            {"scene", spec.scene},
            {"drive", spec.drive},
            {"camera_path", spec.cameraPath},
            {"dust", spec.dust},
            {"dust_columns", spec.dustColumns},
            {"dust_on", dustPlaces.wordOf(spec.dustOn)},
            {"seed", spec.seed},
            {"repetition", spec.repetition},
            {"frames", spec.frames},
            {"warmup", spec.warmup},
            {"width", spec.size.width},
            {"height", spec.size.height},
            {"sync", syncs.wordOf(spec.sync)},
            {"threads", spec.threads},
            {"times", spec.timed},
            {"images", spec.imagesEvery},
            {"volumes", volumesObject(spec.volumes)},
            {"metrics", metricPlanObject(spec.metricPlan)},
            {"parameters", spec.parameters}};
}

/// The specification as recorded in results, with the resolved drive.
Json resolvedSpecObject(const RunSpec& spec, const std::string& drive) {
    Json object = specObject(spec);
    object["drive"] = drive;
    for (const char* name : {"camera_path", "dust", "dust_columns"})
        if (object[name].get_ref<const std::string&>().empty()) object[name] = nullptr;
    object["parameters"] = parametersObject(spec.parameters);
    return object;
}

/// Invalid UTF-8 (in a file name or a child's output) must not prevent a result from being written.
std::string text(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string valueText(const Value& value) {
    return cellText(toValue(value));
}

std::string toJson(const RunRecord& record) {
    const RunSpec& spec = record.spec;
    Json memory = Json::array();
    for (const auto& [owner, use] : record.memory)
        memory.push_back(
            {{"owner", owner}, {"structure", use.structure}, {"cpu_bytes", use.cpuBytes}, {"gpu_bytes", use.gpuBytes}});
    Json provenance = provenanceObject(record.provenance);
    provenance["key"] = canonicalKey(spec);
    Json object{{"run_id", runId(spec)}, {"status", runStatuses.wordOf(record.status)}, {"reason", record.reason}};
    object.update(resolvedSpecObject(spec, record.drive));
    object.update({{"state_hash", record.stateHash},
                   {"method_hash", record.methodHash.empty() ? Json(nullptr) : Json(record.methodHash)},
                   {"validity", record.validity},
                   {"summary", columnsObject(record.summary)},
                   {"memory", memory},
                   {"outputs", outputsArray(record.outputs)},
                   {"provenance", provenance},
                   {"warnings", record.provenance.warnings}});
    return text(object);
}

std::string toJson(const ExportRecord& record) {
    const RunSpec& spec = record.spec;
    Json frames = Json::array();
    for (const ExportRecord::Moment& moment : record.moments)
        frames.push_back({{"frame", moment.frame}, {"time_s", moment.timeSeconds}, {"state_hash", moment.stateHash}});
    return text({{"method", spec.method},
                 {"scene", spec.scene},
                 {"drive", record.drive},
                 {"seed", spec.seed},
                 {"warmup", spec.warmup},
                 {"width", spec.size.width},
                 {"height", spec.size.height},
                 {"threads", spec.threads},
                 {"volumes", volumesObject(spec.volumes)},
                 {"parameters", parametersObject(spec.parameters)},
                 {"frames", frames},
                 {"series", record.series},
                 {"provenance", provenanceObject(record.provenance)}});
}

std::string specToJson(const RunSpec& spec) {
    return text(specObject(spec));
}

RunSpec specFromJson(std::string_view text) {
    try {
        const Json json = Json::parse(text);
        RunSpec spec;
        spec.method = json.at("method").get<std::string>();
        spec.scene = json.at("scene").get<std::string>();
        spec.drive = json.at("drive").get<std::string>();
        spec.cameraPath = json.at("camera_path").get<std::string>();
        spec.dust = json.at("dust").get<std::string>();
        spec.dustColumns = json.at("dust_columns").get<std::string>();
        spec.dustOn = dustPlaces.parse("dust_on", json.at("dust_on").get<std::string>());
        for (const auto& [name, value] : json.at("parameters").items())
            spec.parameters[name] = value.get<std::string>();
        spec.frames = json.at("frames").get<std::int64_t>();
        spec.warmup = json.at("warmup").get<std::int64_t>();
        spec.size = {json.at("width").get<int>(), json.at("height").get<int>()};
        spec.seed = json.at("seed").get<std::uint64_t>();
        spec.threads = json.at("threads").get<int>();
        spec.sync = syncs.parse("sync", json.at("sync").get<std::string>());
        spec.timed = json.at("times").get<bool>();
        spec.imagesEvery = json.at("images").get<std::int64_t>();
        spec.volumes = readVolumes(json.at("volumes"));
        spec.metricPlan = readMetricPlan(json.at("metrics"));
        spec.repetition = json.at("repetition").get<int>();
        return spec;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(std::string("run specification: ") + error.what());
    }
}

std::string listToJson(const std::vector<ListedItem>& items) {
    Json list = Json::array();
    for (const ListedItem& item : items) {
        Json object = columnsObject(item.cells);
        if (item.withParameters) {
            object["parameters"] = Json::array();
            for (const Parameter& parameter : item.parameters)
                object["parameters"].push_back({{"name", parameter.name},
                                                {"allowed", parameter.allowed()},
                                                {"default", typed(parameter.initial)},
                                                {"unit", parameter.unit},
                                                {"help", parameter.help}});
        }
        list.push_back(object);
    }
    return text(list);
}

std::string provenanceToJson(const measure::Provenance& provenance, std::span<const gpu::Adapter> adapters,
                             const Columns& more) {
    Json object = provenanceObject(provenance);
    object["adapters"] = Json::array();
    for (const gpu::Adapter& adapter : adapters)
        object["adapters"].push_back({{"index", adapter.index},
                                      {"name", adapter.name},
                                      {"renderer", adapter.renderer},
                                      {"kind", gpu::kindName(adapter.kind)},
                                      {"platform", gpu::platformName(adapter.platform)},
                                      {"problem", adapter.problem},
                                      {"chosen", adapter.index == provenance.device.adapterIndex}});
    object.update(columnsObject(more));
    object["warnings"] = provenance.warnings;
    return text(object);
}

}  // namespace dustbench::results
