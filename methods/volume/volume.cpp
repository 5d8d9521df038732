#include "methods/volume/volume.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/volumes/volume_series.h"
#include "methods/volume/sparse/sparse_storage.h"
#include "methods/volume/storage.h"

namespace dustbench::volume {
namespace {

/// A volume stored as one box of cells, drawn by any grid renderer. Owns the moments of the series, and the picture.
class DenseStorage final : public Storage {
 public:
    /// Reads the files. `device` must outlive this. Throws InputError.
    DenseStorage(const VolumeSettings& settings, const scene::Lights& lights, gpu::Device& device);

    [[nodiscard]] bool isStill() const override { return series_.isStill(); }
    [[nodiscard]] double seconds() const override { return series_.seconds(); }
    void show(double seconds, const StageClock& clock) override;
    void draw(const scene::View& view, gpu::Layer& layer) override { picture_.draw(view, layer); }
    void handOver(double seconds, VolumeVisitor& visitor) const override;
    [[nodiscard]] double massSquareMetres() const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override { return picture_.primitives(); }

 private:
    /// Freshness of fire by temperature; empty without fire.
    [[nodiscard]] std::span<const float> reactionOf(const volumes::VolumeGrid& grid);

    VolumeSettings settings_;
    volumes::VolumeSeries series_;
    volumes::VolumeGrid between_;                 ///< the interpolated grid between two moments
    const volumes::VolumeGrid* shown_ = nullptr;  ///< a moment, or `between_`
    std::vector<float> reaction_;
    MemoryLedger ledger_;
    raycast::GridRaycast picture_;
};

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

constexpr double asTheFileSays = -1;

double secondsOf(const Frame& frame) {
    return static_cast<double>(std::max<std::int64_t>(frame.index, 0)) * frame.stepSeconds;
}

VolumeSettings settingsOf(const ParameterValues& values) {
    VolumeSettings settings;
    settings.setup = volumes::readVolumeSetup(
        files::findData("volume", "volumes", values.choice("volume"), volumes::volumeExtensions));
    settings.picture = raycast::raycastSettings(values, settings.setup.shadowCells);
    double& extinction = settings.picture.extinctionPerMetre = settings.setup.extinctionPerMetre;
    if (const double given = values.real("extinction"); given >= 0)
        extinction = given;
    else if (given != asTheFileSays)
        throw InputError("parameter extinction: got " + std::to_string(given) +
                         ", allowed: 0 or more, or -1 for the value of the volume's file");
    if (values.choice("storage", keepings) == Keeps::sparse) requireSparse(settings.picture);
    if (!settings.setup.fire.empty()) settings.picture.fire = raycast::loadTransferFunction(settings.setup.fire);
    return settings;
}

}  // namespace

void Volume::prepare(const scene::Scene& scene, const RunSetup&, gpu::Device& device) {
    if (scene.lights.onDust) raycast::lightDust(settings_.picture, scene);
    settings_.picture.smokeColour = settings_.setup.albedo.value_or(scene.dustAlbedo);
    storage_.reset();
    if (keeps_ == Keeps::sparse)
        storage_ = std::make_unique<SparseStorage>(settings_, scene.lights, device);
    else
        storage_ = std::make_unique<DenseStorage>(settings_, scene.lights, device);
}

void Volume::update(const Frame& frame) {
    storage_->show(secondsOf(frame), frame.clock);
}

void Volume::draw(const Frame& frame, gpu::Layer& layer) {
    storage_->draw(frame.view, layer);
}

void Volume::volume(const Frame& frame, VolumeVisitor& visitor) const {
    storage_->handOver(secondsOf(frame), visitor);
}

void Volume::report(const Frame& frame, Facts& facts) const {
    const double beyond = secondsOf(frame) - storage_->seconds();
    facts.set("volume_held", storage_->isStill() || beyond <= volumes::sameMomentSeconds ? 0.0 : beyond);
    facts.set("volume_mass", storage_->massSquareMetres());
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Volume";
    info.summary = "Ray casts smoke or fire from files of other programs.";
    info.takesLights = true;
    info.parameters
        .dataFile("volume", "cloud", "volumes", std::string(volumes::volumeExtensions),
                  files::listData("volumes", volumes::volumeExtensions),
                  "volume to show: a file, several files by a *, a series that names them, or a .toml with settings")
        .real("extinction", asTheFileSays, asTheFileSays, 1e6, "1/m",
              "extinction at a density of 1; -1: the value of the .toml, or 1")
        .choice(
            "storage", Keeps::dense, keepings,
            "dense: every cell of the box around the density; sparse: only bricks of 8x8x8 cells with density, which "
            "take less memory if most of the box is empty; sparse requires renderer=raycast and filter=linear");
    raycast::declareRaycast(info.parameters);
    info.facts = {{"volume_mass", "m2", FactOver::lastFrame,
                   "integral of the extinction over the displayed volume, after the last frame"},
                  {"volume_held",
                   "s",
                   FactOver::lastFrame,
                   "time since the end of the volume's series, whose last moment stays, after the last frame",
                   {0, 0}}};
    info.takesGpuDust = [](const ParameterValues&) { return true; };  // it does not show the shared dust
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<Volume>(settingsOf(values), values.choice("storage", keepings));
    };
    return info;
}

}  // namespace dustbench::volume
