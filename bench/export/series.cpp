#include "bench/export/series.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/export/whole_file.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
