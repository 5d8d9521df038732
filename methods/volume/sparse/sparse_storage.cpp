#include "methods/volume/sparse/sparse_storage.h"

#include <fmt/format.h>

#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"

namespace dustbench::volume {

SparseStorage::SparseStorage(const VolumeSettings& settings, const scene::Lights& lights, gpu::Device& device)
    : settings_(settings.picture),
      series_(settings.setup, ledger_),
      picture_(device, settings.picture, lights, ledger_) {}

void SparseStorage::show(double seconds, const StageClock& clock) {
    const SparseMoment* moment = nullptr;
    {
        const auto timing = clock.measure(Stage::build);
        moment = &series_.at(seconds);
        if (series_.shows() == shows_) return;
        shows_ = series_.shows();
    }
    const auto timing = clock.measure(Stage::upload);
    picture_.upload(*moment);
}

void SparseStorage::handOver(double seconds, VolumeVisitor& visitor) const {
    const SparseMoment& moment = series_.at(seconds);
    const raycast::ShownGrid place = moment.place();
    const double cells =
        static_cast<double>(place.cells.x) * static_cast<double>(place.cells.y) * static_cast<double>(place.cells.z);
    if (cells > static_cast<double>(files::limits::volumeCells))
        throw InputError(
            fmt::format("storage=sparse: the whole box of the volume has {:.4g} cells, allowed for a dense copy: "
                        "{:.4g} (limit of volumes)",
                        cells, static_cast<double>(files::limits::volumeCells)));
    std::vector<float> density(place.cellCount());
    for (std::size_t leaf = 0; leaf < moment.density.leafCount(); ++leaf) {
        const float* value = moment.density.valuesOf(leaf);
        const glm::ivec3 first = moment.density.brickOf(leaf) * brickEdge - moment.firstCell;
        for (int x = first.x; x < first.x + brickEdge; ++x)
            for (int y = first.y; y < first.y + brickEdge; ++y)
                for (int z = first.z; z < first.z + brickEdge; ++z, ++value)
                    if (*value > 0)
                        density[static_cast<std::size_t>(x) +
                                static_cast<std::size_t>(place.cells.x) *
                                    (static_cast<std::size_t>(y) +
                                     static_cast<std::size_t>(place.cells.y) * static_cast<std::size_t>(z))] = *value;
    }
    std::vector<float> extinction = density;
    for (float& value : extinction) value *= static_cast<float>(settings_.extinctionPerMetre);
    const std::vector<GridField> fields{{"density", "as in the file", 1, density}};
    visitor.grid({place.originMetres, place.spacingMetres, place.cells, extinction, fields});
}

double SparseStorage::massSquareMetres() const {
    const SparseMoment& moment = series_.shown();
    return moment.density.sum() * settings_.extinctionPerMetre * std::pow(moment.spacingMetres, 3);
}

MemoryReport SparseStorage::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    report.push_back({"picture", 0, picture_.gpuBytes()});
    return report;
}

}  // namespace dustbench::volume
