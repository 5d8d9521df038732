#include "bench/scene/dust_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/vector_series.h"
#include "methods/kit/volumes/vtp_file.h"
#include "methods/kit/volumes/xml_scan.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

constexpr const char* endings = ".vtp, .vdb, .csv, .pvd or .series";
constexpr std::size_t bytesPerParticle = 2 * sizeof(std::uint64_t) + 13 * sizeof(float);

struct Entry {
    fs::path file;
    std::optional<double> timeSeconds;
};

/// The files that an index names are relative to it.
Entry entryOf(const fs::path& index, const std::string& name, std::optional<double> time) {
    if (name.empty() || !time)
        throw InputError(index.string() + ": an entry has no file or no time that is a number, expected both");
    return {index.parent_path() / name, time};
}

void requireFew(const std::vector<Entry>& entries, const fs::path& path) {
    if (entries.empty()) throw InputError(path.string() + ": names no files, expected one or more");
    if (entries.size() > static_cast<std::size_t>(files::limits::dustMoments))
        throw InputError(fmt::format("{}: names {} files, allowed: {} (limit of dust)", path.string(), entries.size(),
                                     files::limits::dustMoments));
}

std::vector<Entry> readPvd(const fs::path& file) {
    const std::string text = files::wholeText(file, "a .pvd file");
    std::vector<Entry> entries;
    try {
        volumes::XmlScan scan(text);
        std::optional<volumes::Tag> tag;
        std::vector<std::string_view> path;
        bool isCollection = false;
        for ((void)scan.next(tag); tag; (void)scan.next(tag)) {
            if (tag->kind == volumes::Tag::Kind::close) {
                if (path.empty() || path.back() != tag->name) throw volumes::VolumeFault{"its XML is damaged"};
                path.pop_back();
                continue;
            }
            if (path.empty()) isCollection = tag->name == "VTKFile" && (*tag)["type"] == "Collection";
            if (!isCollection) throw volumes::VolumeFault{"it is no collection"};
            if (tag->name == "DataSet")
                entries.push_back(entryOf(file, std::string((*tag)["file"]), files::numberOf((*tag)["timestep"])));
            if (tag->kind == volumes::Tag::Kind::open) path.push_back(tag->name);
        }
        if (!path.empty() || !isCollection) throw volumes::VolumeFault{"it ends within its XML"};
    } catch (const volumes::VolumeFault& fault) {
        throw InputError(fmt::format("{}: not a complete ParaView collection (.pvd): {}", file.string(),
                                     files::printable(fault.reason)));
    }
    return entries;
}

std::vector<Entry> readSeries(const fs::path& file) {
    const std::string text = files::wholeText(file, "a .series file");
    std::vector<Entry> entries;
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

InputError tooMany(const fs::path& file, double count) {
    return InputError(fmt::format("{}: has {:.0f} particles, allowed: {} (limit of dust)", file.string(), count,
                                  files::limits::dustParticles));
}

/// A table of one moment, or of all of them, by its column of times.
void readCsv(const fs::path& file, const DustColumns& columns, std::vector<DustMoment>& moments) {
    const files::CsvTable csv = files::CsvTable::parseFile(file);
    volumes::PointTable whole;
    whole.points = csv.rows();
    for (const std::string& name : csv.header()) {
        volumes::PointColumn& column = whole.columns.emplace_back(volumes::PointColumn{name, 1, {}});
        if (!columns.wants(name)) continue;
        column.values.reserve(csv.rows());
        for (std::size_t row = 0; row < csv.rows(); ++row) column.values.push_back(csv.number(row, name));
    }
    const auto time = columns.find(whole, "time", file.string());
    for (std::size_t begin = 0, end = 0; begin < whole.points || begin == 0; begin = end) {
        end = begin + 1;
        while (end < whole.points && (!time || time->at(end) == time->at(begin))) ++end;
        end = std::min(end, whole.points);
        if (end - begin > static_cast<std::size_t>(files::limits::dustParticles))
            throw tooMany(file, static_cast<double>(end - begin));
        volumes::PointTable part;
        part.points = end - begin;
        if (time && part.points > 0) part.timeSeconds = time->at(begin);
        for (const volumes::PointColumn& column : whole.columns) {
            volumes::PointColumn& own = part.columns.emplace_back(volumes::PointColumn{column.name, 1, {}});
            if (!column.values.empty())
                own.values.assign(column.values.begin() + static_cast<std::ptrdiff_t>(begin),
                                  column.values.begin() + static_cast<std::ptrdiff_t>(end));
        }
        const std::string name =
            time && part.timeSeconds ? fmt::format("{} at {} s", file.string(), *part.timeSeconds) : file.string();
        moments.push_back(dustMoment(part, columns, name));
        if (whole.points == 0) break;
    }
}

void readOne(const Entry& entry, const DustColumns& columns, std::vector<DustMoment>& moments) {
    files::noteInput(entry.file);
    const std::string extension = entry.file.extension();
    const auto wants = [&columns](std::string_view name) { return columns.wants(name); };
    const std::size_t before = moments.size();
    if (extension == ".vtp") {
        moments.push_back(dustMoment(volumes::readVtp(entry.file, wants), columns, entry.file.string()));
    } else if (extension == ".vdb") {
        moments.push_back(dustMoment(volumes::readVdbPoints(entry.file, wants), columns, entry.file.string()));
    } else if (extension == ".csv") {
        readCsv(entry.file, columns, moments);
        if (entry.timeSeconds && moments.size() != before + 1)
            throw InputError(entry.file.string() + ": has more than one time, expected one, for a series names it");
    } else {
        throw InputError(fmt::format("dust: got '{}', expected a file that ends in {}", entry.file.string(), endings));
    }
    if (entry.timeSeconds) moments.back().timeSeconds = entry.timeSeconds;
}

std::vector<Entry> entriesOf(const fs::path& path) {
    const std::string extension = path.extension();
    if (extension == ".pvd") return readPvd(path);
    if (extension == ".series") return readSeries(path);
    std::vector<Entry> entries;
    if (path.filename().string().find('*') == std::string::npos) return {{path, {}}};
    for (const fs::path& file : volumes::matchingFiles(path)) entries.push_back({file, {}});
    return entries;
}

}  // namespace

void requireDustFits(double particles, const fs::path& path) {
    const double bytes = particles * static_cast<double>(bytesPerParticle);
    if (bytes > static_cast<double>(files::limits::dustBytes))
        throw InputError(
            fmt::format("{}: its moments have {:.0f} particles, which need {:.3g} GB, allowed: {:.3g} GB "
                        "(limit of dust)",
                        path.string(), particles, bytes / 1e9, static_cast<double>(files::limits::dustBytes) / 1e9));
}

DustFiles readDustFiles(const fs::path& path, const DustColumns& columns) {
    const std::vector<Entry> entries = entriesOf(path);
    requireFew(entries, path);
    DustFiles dust;
    if (entries.size() != 1 || entries.front().file != path) {
        if (path.filename().string().find('*') == std::string::npos) {
            files::noteInput(path);
            dust.files.push_back(path);
        }
    }
    double particles = 0;
    for (const Entry& entry : entries) {
        const std::size_t before = dust.moments.size();
        readOne(entry, columns, dust.moments);
        for (std::size_t i = before; i < dust.moments.size(); ++i)
            particles += static_cast<double>(dust.moments[i].size());
        requireDustFits(particles, path);
        dust.files.push_back(entry.file);
    }
    return dust;
}

}  // namespace dustbench::bench
