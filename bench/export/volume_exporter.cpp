#include "bench/export/volume_exporter.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <set>

#include "bench/export/htg_writer.h"
#include "bench/export/scene_writer.h"
#include "bench/export/surface_writer.h"
#include "bench/export/vdb_writer.h"
#include "bench/export/vti_writer.h"
#include "bench/export/vtp_writer.h"
#include "bench/export/whole_file.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/memory/available_memory.h"

namespace dustbench::bench {
namespace fs = std::filesystem;

namespace {

/// A name in a form that is valid within a file name.
std::string fileWord(std::string name) {
    for (char& letter : name)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
    return name;
}

}  // namespace

std::string whyNotWritable(const CollectedVolume& volume, VolumeFormat format) {
    switch (format) {
        case VolumeFormat::vtp:
            return {};
        case VolumeFormat::vti:
        case VolumeFormat::vdb:
            return volume.isNothing() ? "provides no volume" : "";
        case VolumeFormat::htg:
            if (volume.isOneOctree()) return {};
            return volume.octrees().empty() ? "provides no octree" : "provides more than one octree";
    }
    return {};
}

void requireWritable(const CollectedVolume& volume, const std::vector<VolumeFormat>& formats, std::string_view method) {
    for (const VolumeFormat format : formats) {
        const std::string reason = whyNotWritable(volume, format);
        if (reason.empty()) continue;
        std::vector<VolumeFormat> possible{VolumeFormat::vti, VolumeFormat::htg, VolumeFormat::vtp, VolumeFormat::vdb};
        std::erase_if(possible, [&](VolumeFormat each) { return !whyNotWritable(volume, each).empty(); });
        throw InputError(fmt::format("format {}: method {} {}; possible formats: {}", volumeFormats.wordOf(format),
                                     method, reason, formatsText(possible)));
    }
}

VolumeExporter::VolumeExporter(VolumeSettings settings, fs::path folder)
    : settings_(std::move(settings)), folder_(std::move(folder)) {
    if (settings_.region) requireMemory(planGrid(settings_.region, settings_.resolution), settings_, availableBytes());
    if (folder_.empty()) throw InputError("output: got an empty name, expected a folder");
    std::error_code error;
    madeFolder_ = fs::create_directories(folder_, error);
    if (error) files::failWriting(folder_, error.value());
    lock_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) files::failWriting(folder_, errno);
    const bool isWritable = access(folder_.c_str(), W_OK | X_OK) == 0;
    if (!isWritable || flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        const int why = errno;
        close(lock_);
        if (isWritable && why == EWOULDBLOCK) throw cannotWrite(folder_, "another dustbench is writing into it");
        files::failWriting(folder_, why);
    }
    removeUnfinished(folder_);
}

VolumeExporter::~VolumeExporter() {
    if (madeFolder_) rmdir(folder_.c_str());  // fails if it is not empty
    close(lock_);
}

void VolumeExporter::leaveOut(VolumeFormat format) {
    std::erase(settings_.formats, format);
}

std::string VolumeExporter::nameOf(std::int64_t frame, std::string_view extension) const {
    return fmt::format("f{:06}.{}", frame, extension);
}

void VolumeExporter::addTo(const std::string& series, Series::Kind kind, const std::string& name, double timeSeconds) {
    const fs::path file = folder_ / series;
    auto found = std::ranges::find(series_, file, &Series::file);
    if (found == series_.end()) {
        series_.emplace_back(file, kind);
        found = std::prev(series_.end());
    }
    found->add(name, timeSeconds);
}

void VolumeExporter::writeGrids(const ExportedMoment& moment) {
    const double time = moment.state.timeSeconds;
    const GridPlan plan = planGrid(settings_.region ? settings_.region : moment.volume.bounds(), settings_.resolution);
    requireMemory(plan, settings_, availableBytes());
    const ExtinctionGrid grid = computeGrid(moment.volume, plan);
    if (settings_.wants(VolumeFormat::vti)) {
        const std::string name = nameOf(moment.frame, "vti");
        writeVti(grid, time, folder_ / name);
        addTo("extinction.pvd", Series::Kind::pvd, name, time);
        if (!firstGrid_) firstGrid_ = plan;
        gridsDiffer_ = gridsDiffer_ || plan != *firstGrid_;
        addTo("extinction.vti.series", Series::Kind::json, name, time);
    }
    if (settings_.wants(VolumeFormat::vdb)) {
        const std::string name = nameOf(moment.frame, "vdb");
        writeVdb(grid, settings_.vdbPrecision, moment.frame, time, folder_ / name);
        addTo("density.vdb.series", Series::Kind::json, name, time);
    }
}

/// Writes a method's own grid with all its fields, in addition to the extinction that every cloud has.
void VolumeExporter::writeOwnGrid(const ExportedMoment& moment) {
    if (moment.volume.grids().empty()) return;
    const CollectedGrid& grid = moment.volume.grids().front();
    const double time = moment.state.timeSeconds;
    const std::string stem = fmt::format("f{:06}_{}", moment.frame, moment.method);
    if (settings_.wants(VolumeFormat::vti)) {
        writeGridVti(grid, time, folder_ / (stem + ".vti"));
        addTo(fmt::format("{}_grid.pvd", moment.method), Series::Kind::pvd, stem + ".vti", time);
    }
    if (settings_.wants(VolumeFormat::vdb)) {
        writeGridVdb(grid, moment.frame, time, folder_ / (stem + ".vdb"));
        addTo(fmt::format("{}_grid.vdb.series", moment.method), Series::Kind::json, stem + ".vdb", time);
    }
}

/// Writes each surface that the method changes, in addition to its own particles.
void VolumeExporter::writeSurfaces(const ExportedMoment& moment) {
    const double time = moment.state.timeSeconds;
    std::set<std::string> parts;
    for (const CollectedSurface& surface : moment.volume.surfaces()) {
        std::string part = fmt::format("{}_{}", moment.method, fileWord(surface.name));
        while (!parts.insert(part).second) part += '_';  // names that differ only in replaced characters
        const std::string mesh = fmt::format("f{:06}_{}.vtp", moment.frame, part);
        writeSurface(surface, time, folder_ / mesh);
        addTo(part + ".pvd", Series::Kind::pvd, mesh, time);
        const std::string heights = fmt::format("f{:06}_{}_heights.exr", moment.frame, part);
        writeHeights(surface, folder_ / heights);
        addTo(part + "_heights.exr.series", Series::Kind::json, heights, time);
    }
}

void VolumeExporter::write(const ExportedMoment& moment) {
    requireWritable(moment.volume, settings_.formats, moment.method);
    const double time = moment.state.timeSeconds;
    if (settings_.wants(VolumeFormat::vti) || settings_.wants(VolumeFormat::vdb)) {
        writeGrids(moment);
        writeOwnGrid(moment);
    }
    if (settings_.wants(VolumeFormat::htg)) {
        const std::string name = nameOf(moment.frame, "htg");
        writeHtg(moment.volume.octrees().front(), time, folder_ / name);
        addTo("octree.pvd", Series::Kind::pvd, name, time);
    }
    if (settings_.wants(VolumeFormat::vtp)) {
        const std::string name = nameOf(moment.frame, "vtp");
        writeVtp(moment.dust, time, folder_ / name);
        addTo("particles.pvd", Series::Kind::pvd, name, time);
        if (const auto& own = moment.volume.particles(); own && own->serial.data() != moment.dust.serial.data()) {
            const std::string ownName = fmt::format("f{:06}_{}.vtp", moment.frame, moment.method);
            writeVtp(*own, time, folder_ / ownName);
            addTo(fmt::format("{}.pvd", moment.method), Series::Kind::pvd, ownName, time);
        }
        writeSurfaces(moment);
    }
    if (settings_.formats == std::vector{VolumeFormat::vdb}) return;
    const std::string name = nameOf(moment.frame, "vtm");
    writeScene(moment.scene, moment.state, groundAround(moment.volume.bounds(), moment.scene, moment.state), time,
               folder_ / name);
    addTo("scene.pvd", Series::Kind::pvd, name, time);
}

std::vector<fs::path> VolumeExporter::seriesFiles() const {
    std::vector<fs::path> files;
    files.reserve(series_.size());
    for (const Series& series : series_) files.push_back(series.file());
    return files;
}

}  // namespace dustbench::bench
