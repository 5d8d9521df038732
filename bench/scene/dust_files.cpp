#include "bench/scene/dust_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "bench/scene/volume_dust.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/volumes/file_series.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/volume_series.h"
#include "methods/kit/volumes/vtp_file.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

constexpr const char* endings = ".vtp, .vdb, .nvdb, .vti, .csv, .toml, .pvd or .series";
constexpr std::size_t bytesPerParticle = 2 * sizeof(std::uint64_t) + 13 * sizeof(float);

InputError tooMany(const fs::path& file, double count) {
    return InputError(fmt::format("{}: has {:.0f} particles, allowed: {} (limit of dust)", file.string(), count,
                                  files::limits::dustParticles));
}

/// A table of one moment, or of several if it has a column of times.
void readCsv(const fs::path& file, const DustColumns& columns, std::vector<DustMoment>& moments) {
    const files::CsvTable csv = files::CsvTable::parseFile(file);
    volumes::PointTable whole;
    whole.points = csv.rows();
    for (const std::string& name : csv.header()) {
        volumes::PointColumn& column = whole.columns.emplace_back(volumes::PointColumn{name, 1, {}});
        if (!columns.wants(name)) continue;
        if (std::ranges::count(csv.header(), name) > 1)
            throw InputError(fmt::format("{}:1: the column '{}' appears twice", file.string(), name));
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
        if (time) std::erase(moments.back().unused, files::namedPart("column", time->name));
        if (whole.points == 0) break;
    }
}

/// False for a `.vdb` without points.
bool readOne(const volumes::SeriesEntry& entry, const DustColumns& columns, std::vector<DustMoment>& moments) {
    files::noteInput(entry.file);
    const std::string extension = entry.file.extension();
    const auto wants = [&columns](std::string_view name) { return columns.wants(name); };
    const std::size_t before = moments.size();
    if (extension == ".vtp") {
        moments.push_back(dustMoment(volumes::readVtp(entry.file, wants), columns, entry.file.string()));
    } else if (extension == ".vdb") {
        const auto points = volumes::findVdbPoints(entry.file, wants);
        if (!points) return false;
        moments.push_back(dustMoment(*points, columns, entry.file.string()));
    } else if (extension == ".csv") {
        readCsv(entry.file, columns, moments);
        if (entry.timeSeconds && moments.size() != before + 1)
            throw InputError(entry.file.string() + ": has more than one time, expected one per file of a series");
    } else {
        throw InputError(fmt::format("dust: got '{}', expected a file that ends in {}", entry.file.string(), endings));
    }
    if (entry.timeSeconds) moments.back().timeSeconds = entry.timeSeconds;
    for (std::size_t i = before; i < moments.size(); ++i) files::noteIgnored(entry.file, moments[i].unused);
    return true;
}

/// True for files that are always volumes. A `.vdb` without points is a volume too.
bool isVolume(const fs::path& file) {
    const std::string extension = file.extension();
    return extension == ".nvdb" || extension == ".vti" || extension == ".toml";
}

DustFiles readVolumes(const fs::path& path, bool hasColumns) {
    if (hasColumns)
        throw InputError(
            fmt::format("--dust-columns: not allowed with the volume {}, only with particles; name a "
                        "volume's fields in a .toml",
                        path.string()));
    const volumes::VolumeSetup setup = volumes::readVolumeSetup(path);
    const volumes::VolumeSeries series = volumes::VolumeSeries::read(setup);
    DustFiles dust{dustOfVolume(series, setup), {}, setup.albedo};
    if (volumes::isIndex(setup.files) && !files::isPattern(setup.files)) dust.files.push_back(setup.files);
    if (path.extension() == ".toml") dust.files.push_back(path);
    std::ranges::copy(series.files(), std::back_inserter(dust.files));
    return dust;
}

}  // namespace

void requireDustFits(double particles, const fs::path& path) {
    const double bytes = particles * static_cast<double>(bytesPerParticle);
    if (bytes > static_cast<double>(files::limits::dustBytes))
        throw InputError(
            fmt::format("{}: its moments have {:.0f} particles, which need {:.3g} GB of memory, allowed: {:.3g} GB "
                        "(limit of dust)",
                        path.string(), particles, bytes / 1e9, static_cast<double>(files::limits::dustBytes) / 1e9));
}

DustFiles readDustFiles(const fs::path& path, const DustColumns& columns, bool hasColumns) {
    const bool isIndex = volumes::isIndex(path);
    const std::vector<volumes::SeriesEntry> entries = volumes::seriesEntries(path, "dust");
    DustFiles dust;
    if (isVolume(entries.front().file)) return readVolumes(path, hasColumns);
    if (isIndex && !files::isPattern(path)) dust.files.push_back(path);
    double particles = 0;
    for (const volumes::SeriesEntry& entry : entries) {
        const std::size_t before = dust.moments.size();
        if (!readOne(entry, columns, dust.moments)) {
            if (dust.moments.empty()) return readVolumes(path, hasColumns);
            throw InputError(fmt::format("{}: has no points, expected points as in {}", entry.file.string(),
                                         dust.moments.front().file));
        }
        for (std::size_t i = before; i < dust.moments.size(); ++i)
            particles += static_cast<double>(dust.moments[i].size());
        requireDustFits(particles, path);
        dust.files.push_back(entry.file);
    }
    return dust;
}

}  // namespace dustbench::bench
