#include "bench/export/volume_exporter.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bench/export/scene_writer.h"
#include "bench/export/whole_file.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/memory/available_memory.h"

namespace dustbench::exports {
namespace fs = std::filesystem;

std::string whyNotWritable(const CollectedVolume& volume, std::string_view format) {
    const Exporter& exporter = exporterOf(format);
    if (exporter.writeGrid && volume.isNothing()) return "provides no volume";
    return exporter.whyNot ? exporter.whyNot(volume) : "";
}

void requireWritable(const CollectedVolume& volume, const std::vector<std::string>& formats, std::string_view method) {
    for (const std::string& format : formats) {
        const std::string reason = whyNotWritable(volume, format);
        if (reason.empty()) continue;
        std::vector<std::string> possible;
        for (const Exporter& exporter : exporters())
            if (whyNotWritable(volume, exporter.id).empty()) possible.push_back(exporter.id);
        throw InputError(fmt::format("format {}: method {} {}; possible formats: {}", format, method, reason,
                                     formatsText(possible)));
    }
}

VolumeExporter::VolumeExporter(VolumeSettings settings, fs::path folder)
    : folder_(std::move(folder), std::move(settings)) {
    const VolumeSettings& asked = this->settings();
    if (asked.region) requireMemory(planGrid(asked.region, asked.resolution), asked, availableBytes());
    const fs::path& path = folder_.path();
    if (path.empty()) throw InputError("output: got an empty name, expected a folder");
    std::error_code error;
    madeFolder_ = fs::create_directories(path, error);
    if (error) files::failWriting(path, error.value());
    lock_ = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) files::failWriting(path, errno);
    const bool isWritable = access(path.c_str(), W_OK | X_OK) == 0;
    if (!isWritable || flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        const int why = errno;
        close(lock_);
        if (isWritable && why == EWOULDBLOCK) throw cannotWrite(path, "another dustbench is writing into it");
        files::failWriting(path, why);
    }
    removeUnfinished(path);
}

VolumeExporter::~VolumeExporter() {
    if (madeFolder_) rmdir(folder_.path().c_str());  // fails if it is not empty
    close(lock_);
}

void VolumeExporter::leaveOut(std::string_view format) {
    std::erase(folder_.settings().formats, format);
}

/// One grid for all formats that need it.
void VolumeExporter::writeGrids(const ExportedMoment& moment) {
    const auto& wanted = settings().formats;
    if (std::ranges::none_of(wanted, [](const std::string& id) { return exporterOf(id).writeGrid != nullptr; })) return;
    const GridPlan plan =
        planGrid(settings().region ? settings().region : moment.volume.bounds(), settings().resolution);
    requireMemory(plan, settings(), availableBytes());
    const ExtinctionGrid grid = computeGrid(moment.volume, plan);
    for (const std::string& id : wanted) {
        const Exporter& exporter = exporterOf(id);
        if (exporter.writeGrid) exporter.writeGrid(grid, moment, folder_);
        if (!exporter.readersNeedEqualGrids) continue;
        if (!firstGrid_) firstGrid_ = plan;
        gridsDiffer_ = gridsDiffer_ || plan != *firstGrid_;
    }
}

void VolumeExporter::write(const ExportedMoment& moment) {
    requireWritable(moment.volume, settings().formats, moment.method);
    writeGrids(moment);
    bool withScene = false;
    // Grids come first, in this order since the first results: summary.csv names the first series.
    for (const bool ofGrids : {true, false})
        for (const std::string& id : settings().formats) {
            const Exporter& exporter = exporterOf(id);
            if ((exporter.writeGrid != nullptr) != ofGrids) continue;
            if (exporter.write) exporter.write(moment, folder_);
            withScene = withScene || exporter.withScene;
        }
    if (!withScene) return;
    const std::string name = fileOf(moment, "vtm");
    writeScene(moment.scene, moment.state, groundAround(moment.volume.bounds(), moment.scene, moment.state),
               moment.state.timeSeconds, folder_.file(name));
    folder_.addTo("scene.pvd", Series::Kind::pvd, name, moment);
}

}  // namespace dustbench::exports
