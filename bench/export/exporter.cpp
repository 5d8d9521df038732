#include "bench/export/exporter.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "bench/export/whole_file.h"
#include "methods/kit/files/csv.h"

namespace dustbench::exports {

std::string Series::pvdText() const {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (const Entry& entry : entries_)
        text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                            files::csvNumber(entry.timeSeconds), entry.name);
    return text + "  </Collection>\n</VTKFile>\n";
}

std::string Series::jsonText() const {
    using Json = nlohmann::ordered_json;
    Json files = Json::array();
    for (const Entry& entry : entries_) files.push_back(Json{{"name", entry.name}, {"time", entry.timeSeconds}});
    return Json{{"file-series-version", "1.0"}, {"files", std::move(files)}}.dump(2) + '\n';
}

void Series::add(std::string_view name, double timeSeconds) {
    entries_.push_back({std::string(name), timeSeconds});
    writeWhole(file_, kind_ == Kind::pvd ? pvdText() : jsonText());
}

/// Generated from the files NAME_format.cpp (exporter_list.cpp.in).
std::vector<Exporter> describeExporters();

const std::vector<Exporter>& exporters() {
    static const std::vector<Exporter> list = [] {
        std::vector<Exporter> all = describeExporters();
        std::ranges::sort(all, {}, [](const Exporter& exporter) { return std::tie(exporter.place, exporter.id); });
        return all;
    }();
    return list;
}

const Exporter& exporterOf(std::string_view id) {
    const auto found = std::ranges::find(exporters(), id, &Exporter::id);
    if (found == exporters().end()) throw std::invalid_argument("no format '" + std::string(id) + "'");
    return *found;
}

std::string ExporterOption::commandName() const {
    std::string name = "--" + id;
    std::ranges::replace(name, '_', '-');
    return name;
}

std::vector<ExporterOption> exporterOptions() {
    std::vector<ExporterOption> all;
    for (const Exporter& exporter : exporters())
        all.insert(all.end(), exporter.options.begin(), exporter.options.end());
    return all;
}

const ExporterOption& exporterOption(std::string_view id) {
    for (const Exporter& exporter : exporters())
        if (const auto found = std::ranges::find(exporter.options, id, &ExporterOption::id);
            found != exporter.options.end())
            return *found;
    throw std::invalid_argument("no option '" + std::string(id) + "' of a format");
}

std::string fileOf(const ExportedMoment& moment, std::string_view extension) {
    return fmt::format("f{:06}.{}", moment.frame, extension);
}

std::string ownFileOf(const ExportedMoment& moment, std::string_view extension) {
    return fmt::format("f{:06}_{}.{}", moment.frame, moment.method, extension);
}

void ExportFolder::addTo(const std::string& series, Series::Kind kind, const std::string& name,
                         const ExportedMoment& moment) {
    auto found = std::ranges::find(series_, file(series), &Series::file);
    if (found == series_.end()) {
        series_.emplace_back(file(series), kind);
        found = std::prev(series_.end());
    }
    found->add(name, moment.state.timeSeconds);
}

std::vector<std::filesystem::path> ExportFolder::series() const {
    std::vector<std::filesystem::path> files;
    files.reserve(series_.size());
    for (const Series& series : series_) files.push_back(series.file());
    return files;
}

}  // namespace dustbench::exports
