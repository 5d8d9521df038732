#include "methods/relief/relief.h"

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/contract/volume.h"
#include "methods/kit/light/sun_depth.h"

namespace dustbench::relief {
namespace {

constexpr float grainOpacity = 0.95f;

double shareOf(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

Relief::Relief(const Settings& settings) : settings_(settings) {}

void Relief::prepare(const scene::Scene& scene, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    scene_ = &scene;
    for (const scene::Panel& panel : scene.panels)
        reliefs_.emplace_back(scene, panel, settings_.relief, device, ledger_);
    if (scene.vehicle && settings_.relief.style.shadow) carShadow_.emplace(device, scene);
    if (scene.lights.onDust) dustShadow_.emplace(device, scene.lights.toSun);
    dust_.emplace(device, draw::BillboardStyle{});
    grains_.emplace(device, draw::BillboardStyle{});
}

void Relief::update(const Frame& frame) {
    {
        const auto timing = frame.clock.measure(Stage::simulate);
        simulate(frame);
    }
    const auto timing = frame.clock.measure(Stage::upload);
    for (LivingRelief& relief : reliefs_) relief.upload();
    uploadDust(frame.dust, glm::vec3(frame.view.camera.eye));
    if (dustShadow_) {
        copyDust(frame.dust);
        dustShadow_->set(handedOver_);
    }
    uploadGrains(frame);
}

void Relief::simulate(const Frame& frame) {
    {
        const auto detail = frame.clock.measureDetail("create");
        if (!frame.dust.serial.empty()) taken_.forgetBelow(*std::ranges::min_element(frame.dust.serial));
        for (LivingRelief& relief : reliefs_) relief.create(frame, taken_);
    }
    {
        const auto detail = frame.clock.measureDetail("move and collide");
        for (LivingRelief& relief : reliefs_) relief.move(frame.stepSeconds);
    }
    const auto detail = frame.clock.measureDetail("age");
    for (LivingRelief& relief : reliefs_) relief.age();
}

/// Particles inside a relief are not drawn outside it.
void Relief::uploadDust(const Puffs& dust, const glm::vec3& eye) {
    visible_.clear();
    for (const std::uint32_t i : sort_.farToNear(draw::SortKind::radix, {dust.x, dust.y, dust.z}, eye))
        if (!taken_.contains(dust.serial[i])) visible_.push_back(i);
    const draw::InstanceLayout layout = dust_->layout(!dust.uniformColour);
    float* value = dust_->map(visible_.size(), layout).data();
    for (const std::uint32_t i : visible_) {
        for (const float each : {dust.x[i], dust.y[i], dust.z[i], dust.radius[i], dust.opacity[i]}) *value++ = each;
        if (layout.coloured)
            for (const float each : {dust.red[i], dust.green[i], dust.blue[i]}) *value++ = each;
    }
    dust_->unmap();
}

/// Light of the sun through the dust outside the reliefs, and of the sky; the relief's own shadow is neglected.
std::vector<glm::vec3> Relief::litGrains(const Frame& frame) const {
    constexpr double neglectedDepth = 1e-6;
    const light::SunDepth depths(handedOver_, glm::dvec3(scene_->lights.toSun), 1, neglectedDepth);
    std::vector<glm::vec3> colours;
    for (const LivingRelief& relief : reliefs_)
        for (const glm::vec4& place : relief.particles().places()) {
            const glm::dvec3 world = relief.placeInWorld(glm::dvec3(place));
            const glm::dvec3 sight = glm::normalize(world - frame.view.camera.eye);
            const auto cosine = static_cast<float>(glm::dot(sight, glm::dvec3(scene_->lights.toSun)));
            const auto transmittance = static_cast<float>(std::exp(-depths.at(world)));
            colours.push_back(frame.dust.colourOfAll * scene::dustLight(*scene_, transmittance, cosine));
        }
    return colours;
}

void Relief::uploadGrains(const Frame& frame) {
    std::size_t count = 0;
    for (const LivingRelief& relief : reliefs_) count += relief.particles().size();
    const bool lit = dustShadow_ && count > 0;
    const std::vector<glm::vec3> colours = lit ? litGrains(frame) : std::vector<glm::vec3>();
    float* value = grains_->map(count, grains_->layout(lit)).data();
    std::size_t number = 0;
    for (const LivingRelief& relief : reliefs_)
        for (const glm::vec4& place : relief.particles().places()) {
            const glm::vec3 world(relief.placeInWorld(glm::dvec3(place)));
            for (const float each : {world.x, world.y, world.z, settings_.grainMetres, grainOpacity}) *value++ = each;
            if (!lit) continue;
            const glm::vec3& colour = colours[number++];
            for (const float each : {colour.r, colour.g, colour.b}) *value++ = each;
        }
    grains_->unmap();
}

void Relief::draw(const Frame& frame, gpu::Layer& layer) {
    if (!target_ || target_->width() != layer.width() || target_->height() != layer.height())
        target_.emplace(*device_, layer.width(), layer.height());
    if (carShadow_) carShadow_->draw(frame.state);
    target_->begin(layer.sceneDepth());
    {
        const auto detail = frame.clock.measureDetail("reliefs");
        for (LivingRelief& relief : reliefs_)
            relief.draw(frame.view, carShadow_ ? &*carShadow_ : nullptr, dustShadow_ ? &*dustShadow_ : nullptr);
    }
    {
        const auto detail = frame.clock.measureDetail("particles");
        grains_->draw(frame.view, frame.dust.colourOfAll, target_->layer());
        dust_->draw(frame.view, frame.dust.colourOfAll, target_->layer());
    }
    target_->copyTo(layer);
}

/// The dust outside the reliefs.
void Relief::copyDust(const Puffs& dust) const {
    particles::ParticleStore& store = handedOver_;
    store.colourOfAll = dust.colourOfAll;
    store.keepOneColour(dust.uniformColour);
    store.resize(visible_.size());
    for (std::size_t k = 0; k < visible_.size(); ++k) {
        const std::uint32_t i = visible_[k];
        store.serial[k] = dust.serial[i];
        store.x[k] = dust.x[i], store.y[k] = dust.y[i], store.z[k] = dust.z[i];
        store.velocityX[k] = dust.velocityX[i], store.velocityY[k] = dust.velocityY[i];
        store.velocityZ[k] = dust.velocityZ[i];
        store.age[k] = dust.age[i], store.lifetime[k] = dust.lifetime[i];
        store.radius[k] = dust.radius[i], store.opacity[k] = dust.opacity[i];
        if (!dust.uniformColour)
            store.red[k] = dust.red[i], store.green[k] = dust.green[i], store.blue[k] = dust.blue[i];
    }
}

/// The particles within the reliefs, in world space, as they are drawn. Their age counts from their entry.
void Relief::copyGrains(double stepSeconds) const {
    particles::ParticleStore& store = handedOver_;
    for (const LivingRelief& relief : reliefs_) {
        const ReliefParticles& grains = relief.particles();
        const std::size_t first = store.size();
        store.resize(first + grains.size());
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const std::size_t k = first + i;
            const Moving world = relief.inWorld(i);
            const glm::vec3 place(world.place), velocity(world.velocity);
            store.serial[k] = grains.serials()[i];
            store.x[k] = place.x, store.y[k] = place.y, store.z[k] = place.z;
            store.velocityX[k] = velocity.x, store.velocityY[k] = velocity.y, store.velocityZ[k] = velocity.z;
            store.age[k] = grains.places()[i].w * static_cast<float>(stepSeconds);
            store.lifetime[k] = settings_.relief.maximumAgeSteps * static_cast<float>(stepSeconds);
            store.radius[k] = settings_.grainMetres, store.opacity[k] = grainOpacity;
            if (!store.uniformColour)
                store.red[k] = store.colourOfAll.r, store.green[k] = store.colourOfAll.g,
                store.blue[k] = store.colourOfAll.b;
        }
    }
}

void Relief::volume(const Frame& frame, VolumeVisitor& visitor) const {
    copyDust(frame.dust);
    copyGrains(frame.stepSeconds);
    visitor.puffs(handedOver_);
    for (const LivingRelief& relief : reliefs_) relief.handOver(visitor);
}

void Relief::report(const Frame&, Facts& facts) const {
    std::uint64_t hits = 0, initial = 0, takenOff = 0, laidOn = 0, present = 0;
    for (const LivingRelief& relief : reliefs_) {
        hits += relief.hits();
        initial += relief.surface().initialVolume();
        takenOff += relief.surface().takenOffVolume();
        laidOn += relief.surface().laidOnVolume();
    }
    facts.set("hits", static_cast<std::int64_t>(hits));
    facts.set("worn_share", shareOf(takenOff, initial));
    if (!facts.wants("mass_error")) return;
    for (const LivingRelief& relief : reliefs_) present += relief.surface().presentVolume();
    const std::uint64_t expected = initial - takenOff + laidOn;
    facts.set("mass_error", shareOf(std::max(present, expected) - std::min(present, expected), initial));
}

MemoryReport Relief::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    std::size_t reliefs = 0;
    for (const LivingRelief& relief : reliefs_) reliefs += relief.gpuBytes();
    report.push_back({"reliefs", 0, reliefs});
    if (carShadow_) report.push_back({"car shadow", 0, carShadow_->gpuBytes()});
    if (target_) report.push_back({"picture", 0, target_->gpuBytes()});
    if (dust_) report.push_back({"billboards", 0, dust_->gpuBytes() + grains_->gpuBytes()});
    return report;
}

std::int64_t Relief::primitives() const {
    return dust_ ? static_cast<std::int64_t>(dust_->count() + grains_->count()) : 0;
}

std::optional<std::uint64_t> Relief::stateHash() const {
    maths::Hash hash;
    for (const LivingRelief& relief : reliefs_) relief.addTo(hash);
    return hash.value();
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Reliefs worn by dust";
    info.summary =
        "Dust that hits the scene's panels moves within their reliefs, hits their surface and wears it away.";
    info.source = "Bergeron";
    info.drawsPanels = true;
    info.takesLights = true;
    info.parameters
        .choice("motion", MotionLaw::fixed, motionLaws,
                "paper: each step adds the displacement over the particle's whole age, which compounds; fixed: adds "
                "the displacement over the step")
        .choice("state", StateIn::array, statesIn,
                "array: particles in a relief are columns, moved on the CPU; texture: they are two textures, moved by "
                "a shader, as in the paper; paths and hits are the same")
        .choice("ageing", AgeingModel::crater, ageingModels,
                "paper: a hit lowers the texel to the bottom and turns it white; scalar: lowers it by `scalar`; "
                "crater: removes a pit whose volume follows from energy and angle; deposit: the particle stays")
        .choice("search", Search::scatter, searches,
                "gather: each texel tests every hit, as in the paper; scatter: each hit writes its texels; the "
                "results are the same")
        .choice("march", March::safe, marches,
                "paper: linear, then binary steps, which may miss thin details; safe: misses nothing; mesh: draws two "
                "triangles per texel instead of a march, as a reference")
        .integer("linear_steps", 15, 1, 1000, "", "number of linear steps with march=paper")
        .integer("binary_steps", 5, 0, 30, "", "number of binary steps with march=paper")
        .boolean("shadow", true, "draw shadows of the relief on itself, and of the car on reliefs")
        .real("scalar", 0.1, 0, 1, "", "share of the depth by which a hit lowers a texel with ageing=scalar")
        .real("mass_kilograms", 0.05, 0, 1000, "kg", "mass of a particle")
        .real("hardness", 1e4, 1, 1e12, "J/m³", "energy that removes a unit of volume with ageing=crater")
        .real("density", 1500, 1, 1e5, "kg/m³", "density of the deposit with ageing=deposit")
        .real("repose_degrees", 35, 1, 90, "°",
              "angle to the face above which deposits slide with ageing=deposit; 90: they stay where they fall")
        .real("gravity", 9.8, 0, 1000, "m/s²", "gravity within the relief")
        .integer("maximum_age", 600, 1, 1'000'000, "steps", "age at which a particle in the relief dies")
        .real("grain_metres", 0.006, 0.0001, 1, "m", "radius of a particle drawn within the relief")
        .choice("weathering", "dust", {"dust", "rain", "sandstorm", "acid"},
                "what wears the relief away, by mass and hardness: the wheels' dust, drops of rain, sand, or drops of "
                "acid, "
                "for which the surface is soft. The scenes relief_rain, relief_sandstorm and relief_acid have the "
                "weather for it")
        .preset("weathering", "rain", {{"mass_kilograms", "0.001"}, {"hardness", "2000"}, {"grain_metres", "0.005"}})
        .preset("weathering", "sandstorm",
                {{"mass_kilograms", "0.0002"}, {"hardness", "2000"}, {"grain_metres", "0.004"}})
        .preset("weathering", "acid", {{"mass_kilograms", "0.002"}, {"hardness", "500"}, {"grain_metres", "0.006"}});
    info.facts = {
        {"hits", "hits", FactOver::lastFrame, "particles that hit the surface of a relief since the start"},
        {"worn_share", "share", FactOver::lastFrame, "volume removed from the reliefs; relative to initial"},
        {"mass_error", "share", FactOver::lastFrame,
         "error of the reliefs' volume balance, present = initial − removed + deposited; relative to initial"}};
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        Settings settings;
        ReliefSettings& relief = settings.relief;
        relief.motion = values.choice("motion", motionLaws);
        relief.state = values.choice("state", statesIn);
        relief.ageing.model = values.choice("ageing", ageingModels);
        relief.ageing.scalar = values.real("scalar");
        relief.ageing.massKilograms = values.real("mass_kilograms");
        relief.ageing.hardnessJoulesPerCubicMetre = values.real("hardness");
        relief.ageing.densityKilogramsPerCubicMetre = values.real("density");
        relief.ageing.reposeDegrees = values.real("repose_degrees");
        relief.search = values.choice("search", searches);
        relief.style.march = values.choice("march", marches);
        relief.style.linearSteps = static_cast<int>(values.integer("linear_steps"));
        relief.style.binarySteps = static_cast<int>(values.integer("binary_steps"));
        relief.style.shadow = values.boolean("shadow");
        relief.style.whiteHits = relief.ageing.model == AgeingModel::paper;
        relief.gravity = static_cast<float>(values.real("gravity"));
        relief.maximumAgeSteps = static_cast<float>(values.integer("maximum_age"));
        settings.grainMetres = static_cast<float>(values.real("grain_metres"));
        return std::make_unique<Relief>(settings);
    };
    info.cannotTake = [](const scene::Scene& scene) {
        return scene.panels.empty() ? std::string("needs a scene with panels, such as relief_wall") : std::string();
    };
    return info;
}

}  // namespace dustbench::relief
