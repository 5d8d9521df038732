#include "methods/volume/volume.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/raycast/raycast_parameters.h"

namespace dustbench::volume {
namespace {

constexpr double asTheFileSays = -1;

double secondsOf(const Frame& frame) {
    return static_cast<double>(std::max<std::int64_t>(frame.index, 0)) * frame.stepSeconds;
}

}  // namespace

void Volume::prepare(const scene::Scene& scene, const RunSetup&, gpu::Device& device) {
    series_.emplace(volumes::VolumeSeries::read(settings_.setup));
    if (scene.lights.onDust) raycast::lightDust(settings_.picture, scene);
    settings_.picture.smokeColour = settings_.setup.albedo.value_or(scene.dustAlbedo);
    picture_.emplace(device, settings_.picture, scene.lights, ledger_);
}

std::span<const float> Volume::reactionOf(const volumes::VolumeGrid& grid) {
    if (settings_.setup.fire.empty()) return {};
    const auto cold = static_cast<float>(settings_.setup.coldTemperature);
    const float range = static_cast<float>(settings_.setup.hotTemperature) - cold;
    reaction_.resize(grid.temperature.size());
    std::ranges::transform(grid.temperature, reaction_.begin(),
                           [&](float temperature) { return std::clamp((temperature - cold) / range, 0.0f, 1.0f); });
    return reaction_;
}

void Volume::update(const Frame& frame) {
    const volumes::VolumeGrid* const before = shown_;
    std::span<const float> reaction;
    {
        const auto timing = frame.clock.measure(Stage::build);
        shown_ = &series_->at(secondsOf(frame), /*wantsVelocity=*/false, between_);
        if (shown_ == before && shown_ != &between_) return;
        reaction = reactionOf(*shown_);
    }
    const auto timing = frame.clock.measure(Stage::upload);
    picture_->upload({shown_->cells, shown_->spacing, shown_->origin, shown_->density, reaction});
}

void Volume::draw(const Frame& frame, gpu::Layer& layer) {
    picture_->draw(frame.view, layer);
}

void Volume::volume(const Frame& frame, VolumeVisitor& visitor) const {
    volumes::VolumeGrid between;
    const volumes::VolumeGrid& grid = series_->at(secondsOf(frame), /*wantsVelocity=*/true, between);
    std::vector<float> extinction = grid.density, velocity;
    for (float& value : extinction) value *= static_cast<float>(settings_.picture.extinctionPerMetre);
    for (const glm::vec3& v : grid.velocity) velocity.insert(velocity.end(), {v.x, v.y, v.z});
    std::vector<GridField> fields{{"density", "as in the file", 1, grid.density}};
    if (!grid.temperature.empty()) fields.push_back({"temperature", "as in the file", 1, grid.temperature});
    if (!velocity.empty()) fields.push_back({"velocity", "m/s", 3, velocity});
    visitor.grid({grid.origin, grid.spacing, grid.cells, extinction, fields});
}

void Volume::report(const Frame& frame, Facts& facts) const {
    const double beyond = secondsOf(frame) - series_->seconds();
    facts.tell("volume_held", series_->isStill() || beyond <= volumes::sameMomentSeconds ? 0.0 : beyond);
    const double sum = std::accumulate(shown_->density.begin(), shown_->density.end(), 0.0);
    facts.tell("volume_mass", sum * settings_.picture.extinctionPerMetre * std::pow(shown_->spacing, 3));
}

MemoryReport Volume::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    if (series_) report.push_back({"files", series_->bytes(), 0});
    const std::size_t floats = between_.density.size() + between_.temperature.size() + reaction_.size();
    report.push_back({"moment shown", floats * sizeof(float), 0});
    if (picture_) report.push_back({"picture", 0, picture_->gpuBytes()});
    return report;
}

namespace {

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
                         ", allowed: 0 or more, or -1: as the volume's file says");
    if (!settings.setup.fire.empty()) settings.picture.fire = raycast::loadTransferFunction(settings.setup.fire);
    return settings;
}

}  // namespace

MethodInfo describe() {
    MethodInfo info;
    info.title = "Volume";
    info.summary = "Smoke or fire from files that another program made, ray cast.";
    info.takesLights = true;
    info.parameters
        .dataFile("volume", "cloud", "volumes", std::string(volumes::volumeExtensions),
                  files::listData("volumes", volumes::volumeExtensions),
                  "what is shown: one file, several by a *, a series that names them, or a .toml that says more")
        .real("extinction", asTheFileSays, asTheFileSays, 1e6, "1/m", "at a density of 1; -1: as the .toml says, or 1");
    raycast::declareRaycast(info.parameters);
    info.facts = {{"volume_mass", "m2", FactOver::lastFrame,
                   "integral of the extinction over the volume that is shown, after the last frame"},
                  {"volume_held",
                   "s",
                   FactOver::lastFrame,
                   "time since the last moment of the volume's series, which stays, after the last frame",
                   {0, 0}}};
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<Volume>(settingsOf(values));
    };
    return info;
}

}  // namespace dustbench::volume
