#include "methods/volume/volume.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/raycast/raycast_parameters.h"
#include "methods/kit/volumes/series_places.h"
#include "methods/volume/dense_storage.h"
#include "methods/volume/sparse/sparse_storage.h"

namespace dustbench::volume {
namespace {

constexpr double asTheFileSays = -1;

double secondsOf(const Frame& frame) {
    return static_cast<double>(std::max<std::int64_t>(frame.index, 0)) * frame.stepSeconds;
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
                         ", allowed: 0 or more, or -1 for the value of the volume's file");
    if (values.choice("storage", keepings) == Keeps::sparse) requireSparse(settings.picture);
    if (!settings.setup.fire.empty()) settings.picture.fire = raycast::loadTransferFunction(settings.setup.fire);
    return settings;
}

}  // namespace

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
