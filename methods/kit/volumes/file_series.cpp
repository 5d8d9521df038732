#include "methods/kit/volumes/file_series.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/xml_scan.h"

namespace dustbench::volumes {
namespace fs = std::filesystem;
namespace {

/// File names in an index are relative to the index.
SeriesEntry entryOf(const fs::path& index, const std::string& name, std::optional<double> time) {
    if (name.empty() || !time)
        throw InputError(index.string() + ": an entry lacks a file or a numeric time, expected both");
    return {index.parent_path() / name, time};
}

std::vector<SeriesEntry> readPvd(const fs::path& file) {
    const std::string text = files::wholeText(file, "a .pvd file");
    std::vector<SeriesEntry> entries;
    try {
        XmlScan scan(text);
        std::optional<Tag> tag;
        std::vector<std::string_view> path;
        bool isCollection = false;
        for ((void)scan.next(tag); tag; (void)scan.next(tag)) {
            if (tag->kind == Tag::Kind::close) {
                if (path.empty() || path.back() != tag->name) throw VolumeFault{"its XML is damaged"};
                path.pop_back();
                continue;
            }
            if (path.empty()) isCollection = tag->name == "VTKFile" && (*tag)["type"] == "Collection";
            if (!isCollection) throw VolumeFault{"it is not a collection"};
            if (tag->name == "DataSet")
                entries.push_back(entryOf(file, tag->text("file"), files::numberOf((*tag)["timestep"])));
            if (tag->kind == Tag::Kind::open) path.push_back(tag->name);
        }
        if (!path.empty() || !isCollection) throw VolumeFault{"it ends within its XML"};
    } catch (const VolumeFault& fault) {
        throw InputError(fmt::format("{}: not a complete ParaView collection (.pvd): {}", file.string(),
                                     files::printable(fault.reason)));
    }
    return entries;
}

std::vector<SeriesEntry> readSeries(const fs::path& file) {
    const std::string text = files::wholeText(file, "a .series file");
    std::vector<SeriesEntry> entries;
    const auto json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
    const auto list = json.is_object() ? json.find("files") : json.end();
    if (!json.is_object() || list == json.end() || !list->is_array())
        throw InputError(file.string() + ": not a file series (.series): expected an object with an array 'files'");
    for (const auto& each : *list) {
        const bool isWhole = each.is_object() && each.contains("name") && each["name"].is_string() &&
                             each.contains("time") && each["time"].is_number();
        entries.push_back(isWhole ? entryOf(file, each["name"].get<std::string>(), each["time"].get<double>())
                                  : entryOf(file, "", {}));
    }
    return entries;
}

}  // namespace

bool isIndex(const fs::path& path) {
    const std::string extension = path.extension();
    return extension == ".pvd" || extension == ".series" || files::isPattern(path);
}

std::vector<SeriesEntry> seriesEntries(const fs::path& path, std::string_view kind) {
    std::vector<SeriesEntry> entries;
    const std::string extension = path.extension();
    if (files::isPattern(path)) {
        for (const fs::path& file : files::matchingFiles(path)) entries.push_back({file, {}});
    } else if (isIndex(path)) {
        files::noteInput(path);
        entries = extension == ".pvd" ? readPvd(path) : readSeries(path);
    } else {
        entries.push_back({path, {}});
    }
    if (entries.empty()) throw InputError(path.string() + ": names no files, expected one or more");
    if (entries.size() > static_cast<std::size_t>(files::limits::dustMoments))
        throw InputError(fmt::format("{}: names {} files, allowed: {} (limit of {})", path.string(), entries.size(),
                                     files::limits::dustMoments, kind));
    return entries;
}

}  // namespace dustbench::volumes
