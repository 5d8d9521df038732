#include "methods/volume/dense_storage.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dustbench::volume {

DenseStorage::DenseStorage(const VolumeSettings& settings, const scene::Lights& lights, gpu::Device& device)
    : settings_(settings),
      series_(volumes::VolumeSeries::read(settings.setup)),
      picture_(device, settings.picture, lights, ledger_) {}

std::span<const float> DenseStorage::reactionOf(const volumes::VolumeGrid& grid) {
    if (settings_.setup.fire.empty()) return {};
    const auto cold = static_cast<float>(settings_.setup.coldTemperature);
    const float range = static_cast<float>(settings_.setup.hotTemperature) - cold;
    reaction_.resize(grid.temperature.size());
    std::ranges::transform(grid.temperature, reaction_.begin(),
                           [&](float temperature) { return std::clamp((temperature - cold) / range, 0.0f, 1.0f); });
    return reaction_;
}

void DenseStorage::show(double seconds, const StageClock& clock) {
    const volumes::VolumeGrid* const before = shown_;
    std::span<const float> reaction;
    {
        const auto timing = clock.measure(Stage::build);
        shown_ = &series_.at(seconds, /*wantsVelocity=*/false, between_);
        if (shown_ == before && shown_ != &between_) return;
        reaction = reactionOf(*shown_);
    }
    const auto timing = clock.measure(Stage::upload);
    picture_.upload({shown_->cells, shown_->spacing, shown_->origin, shown_->density, reaction});
}

void DenseStorage::handOver(double seconds, VolumeVisitor& visitor) const {
    volumes::VolumeGrid between;
    const volumes::VolumeGrid& grid = series_.at(seconds, /*wantsVelocity=*/true, between);
    std::vector<float> extinction = grid.density, velocity;
    for (float& value : extinction) value *= static_cast<float>(settings_.picture.extinctionPerMetre);
    for (const glm::vec3& v : grid.velocity) velocity.insert(velocity.end(), {v.x, v.y, v.z});
    std::vector<GridField> fields{{"density", "as in the file", 1, grid.density}};
    if (!grid.temperature.empty()) fields.push_back({"temperature", "as in the file", 1, grid.temperature});
    if (!velocity.empty()) fields.push_back({"velocity", "m/s", 3, velocity});
    visitor.grid({grid.origin, grid.spacing, grid.cells, extinction, fields});
}

double DenseStorage::massSquareMetres() const {
    const double sum = std::accumulate(shown_->density.begin(), shown_->density.end(), 0.0);
    return sum * settings_.picture.extinctionPerMetre * std::pow(shown_->spacing, 3);
}

MemoryReport DenseStorage::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    report.push_back({"files", series_.bytes(), 0});
    const std::size_t floats = between_.density.size() + between_.temperature.size() + reaction_.size();
    report.push_back({"moment shown", floats * sizeof(float), 0});
    report.push_back({"picture", 0, picture_.gpuBytes()});
    return report;
}

}  // namespace dustbench::volume
