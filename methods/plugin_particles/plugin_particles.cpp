#include "methods/plugin_particles/plugin_particles.h"

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/particles/event_script.h"
#include "methods/kit/particles/part_list.h"
#include "methods/kit/particles/particle_system.h"
#include "methods/kit/particles/shading_part.h"
#include "methods/kit/particles_gl/step_values.h"

namespace dustbench::plugin_particles {
namespace {

/// Number of systems whose particles are counted as separate facts.
constexpr std::size_t countedSystems = 4;

std::string aliveFact(std::size_t system) {
    return "alive_" + std::to_string(system + 1);
}

/// Returns the systems of the data folder. Always lists the default, so that a missing file is reported on use.
std::vector<std::string> systemNames() {
    std::vector<std::string> names = files::listData("particles", ".toml");
    if (std::ranges::find(names, "wheel_dust") == names.end()) names.emplace_back("wheel_dust");
    return names;
}

std::vector<std::string> storageWords() {
    std::vector<std::string> words = particles::storages.words();
    words.insert(words.begin(), "file");
    return words;
}

/// The first system uses the run's seed, so that `wheel_dust` is the shared dust; the others get different seeds.
std::uint64_t seedOf(std::size_t system, std::uint64_t seed) {
    return seed ^ (system * 0x9e3779b97f4a7c15ULL);
}

std::int64_t shareOf(std::size_t system, std::size_t systems, std::int64_t particles) {
    const auto count = static_cast<std::int64_t>(systems);
    return particles / count + (static_cast<std::int64_t>(system) < particles % count ? 1 : 0);
}

/// Returns the system named at the beginning of a change, and removes that name; a single system need not be named.
std::size_t systemOf(std::string_view& name, const std::vector<std::string>& systems) {
    const std::string_view first = name.substr(0, name.find('.'));
    const auto found = std::ranges::find(systems, first);
    if (found == systems.end()) {
        if (systems.size() == 1) return 0;
        throw unknownName("particle system", first, systems);
    }
    name.remove_prefix(std::min(first.size() + 1, name.size()));
    return static_cast<std::size_t>(found - systems.begin());
}

template <typename PartsOf>
void apply(const Change& change, const std::vector<std::string>& systems, const PartsOf& partsOf) {
    try {
        std::string_view name = change.name;
        particles::PartList& parts = partsOf(systemOf(name, systems));
        particles::changePart(parts, name, change.value);
    } catch (const InputError& error) {
        throw InputError("change " + change.name + "=" + change.value + ": " + error.what());
    }
}

std::vector<particles::NamedParts> systemsOf(const ParameterValues& values) {
    const auto file = files::findData("particle system", "particles", values.choice("system"), ".toml");
    auto systems = particles::systemsFromFile(file);
    try {
        for (particles::NamedParts& system : systems) particles::scaleSizes(*system.parts, values.real("size_factor"));
        if (const auto storage = particles::storages.find(values.choice("storage")))
            for (particles::NamedParts& system : systems) system.parts->setStorage(*storage);
    } catch (const InputError& error) {
        throw InputError(std::string("parameter size_factor: ") + error.what());
    }
    return systems;
}

bool isSame(const scene::View& a, const scene::View& b) {
    return a.camera.eye == b.camera.eye && a.camera.target == b.camera.target && a.camera.up == b.camera.up &&
           a.camera.verticalFieldOfView == b.camera.verticalFieldOfView && a.width == b.width && a.height == b.height;
}

/// Tries the changes on copies of the systems.
void requirePossible(const std::vector<Change>& changes, const std::vector<particles::NamedParts>& systems) {
    std::vector<std::string> names;
    std::vector<particles::NamedParts> copies;
    for (const particles::NamedParts& each : systems) {
        const particles::NamedPartsView view{each.name, *each.parts};
        copies.push_back(
            std::move(particles::systemsFromText(particles::systemsToToml({&view, 1}), each.name).front()));
        names.push_back(each.name);
    }
    for (const Change& change : changes)
        apply(change, names, [&](std::size_t i) -> particles::PartList& { return *copies[i].parts; });
    std::vector<particles::NamedPartsView> views;
    views.reserve(copies.size());
    for (const particles::NamedParts& each : copies) views.push_back({each.name, *each.parts});
    particles::requireScript(views);
}

}  // namespace

PluginParticles::PluginParticles(std::vector<particles::NamedParts> systems, std::vector<Change> changes,
                                 const Sight& sight, SystemsOn processor)
    : parts_(std::move(systems)), changes_(std::move(changes)), sight_(sight), processor_(processor) {
    requirePossible(changes_, parts_);
}

void PluginParticles::prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) {
    scene_ = &scene;
    device_ = &device;
    askedFor_ = setup.particles;
    const std::size_t count = parts_.size();
    if (setup.particles > 0 && setup.particles < static_cast<std::int64_t>(count))
        throw InputError("parameter particles: got " + std::to_string(setup.particles) + ", allowed: 0, or at least " +
                         std::to_string(count) + ", one for each system");
    const auto starts = [](const auto& event) { return !event->action().starts.empty(); };
    for (const particles::NamedParts& each : parts_)
        if (setup.particles > 0 && std::ranges::any_of(each.parts->events(), starts))
            throw InputError("parameter particles: got " + std::to_string(setup.particles) +
                             ", allowed: 0 where events start particles, as those of the system '" + each.name +
                             "' do");
    for (std::size_t i = 0; i < count; ++i)
        systems_.push_back({std::move(parts_[i].name),
                            particles::ParticleSystem(std::move(parts_[i].parts), seedOf(i, setup.seed)),
                            shareOf(i, count, setup.particles)});
    parts_.clear();
    if (scene.lights.onDust) sunlight_ = std::make_unique<Sunlight>(scene);
    for (System& system : systems_) makePicture(system);
    if (processor_ == SystemsOn::gpu) moveToGpu(setup.seed);
}

void PluginParticles::moveToGpu(std::uint64_t seed) {
    const auto refuse = [](const std::string& reason) {
        throw InputError("parameter systems_on: got gpu with " + reason + ", allowed: cpu");
    };
    if (!changes_.empty()) refuse("changes during the run");
    if (sight_.culls || sight_.detailPixels > 0) refuse("culling or detail_pixels");
    if (sunlight_) refuse("light=sun");
    for (std::size_t i = 0; i < systems_.size(); ++i) {
        System& system = systems_[i];
        const particles::PartList& parts = system.particles.parts();
        const std::string named = " of the system '" + system.name + "'";
        if (parts.storage() != particles::Storage::array) refuse("the storage" + named);
        if (const std::string part = particles::partWithoutShader(parts); !part.empty())
            refuse(part + named + ", which has no shader");
        if (!drawsFromGpu(system.picture->look())) refuse("the part render '" + parts.render()->name() + "'" + named);
        system.onGpu = std::make_unique<particles::GpuSystem>(*device_, parts, seedOf(i, seed));
    }
}

/// Keeps the present picture if its look is unchanged.
void PluginParticles::makePicture(System& system) {
    const particles::RenderPart* part = system.particles.parts().render();
    std::string shownAs = part ? part->name() : "puff";
    if (part)
        for (const auto& [name, value] : part->values().canonical()) shownAs.append(" " + name + "=" + value);
    particles::Look look = part ? part->look() : particles::Look();
    const particles::PositionPart* position = system.particles.parts().position();
    if (look.primitive == particles::Primitive::surface) {
        look.lattice = *position->lattice();
        for (const auto& [name, value] : position->values().canonical()) shownAs.append(" " + name + "=" + value);
    }
    if (shownAs == system.shownAs) return;
    system.picture = std::make_unique<SystemPicture>(*device_, look, scene_->lights);
    system.shownAs = std::move(shownAs);
}

void PluginParticles::applyChanges(const Frame& frame) {
    if (applied_ == changes_.size()) return;
    // Negative during preroll and warm-up. A change at the beginning of a frame belongs to that frame despite rounding
    // of its time: the tolerance is a thousandth of a step.
    const double now = (static_cast<double>(frame.index) + 1e-3) * frame.stepSeconds;
    std::vector<std::string> names;
    names.reserve(systems_.size());
    for (const System& system : systems_) names.push_back(system.name);
    for (; applied_ < changes_.size() && changes_[applied_].seconds <= now; ++applied_)
        apply(changes_[applied_], names,
              [&](std::size_t i) -> particles::PartList& { return systems_[i].particles.parts(); });
    for (System& system : systems_) makePicture(system);
}

void PluginParticles::carryEvents() {
    std::vector<particles::ScriptedSystem> scripted;
    scripted.reserve(systems_.size());
    for (System& system : systems_) scripted.push_back({system.name, system.particles});
    if (!particles::applyEvents(scripted)) return;
    for (System& system : systems_) makePicture(system);
}

void PluginParticles::findLights() {
    lights_.clear();
    for (const System& system : systems_)
        for (const auto& part : system.particles.parts().shadings()) {
            const auto glow = part->glow();
            if (!glow) continue;
            for (const particles::EmittedLight& light :
                 particles::emittedLights(system.particles.store(), glow->lights, glow->perMetre, glow->by))
                if (light.colour != glm::vec3(0) && lights_.size() < maximumPointLights)
                    lights_.push_back({glm::dvec3(light.position), light.colour});
        }
}

void PluginParticles::shine() {
    if (!sunlight_) return;
    std::vector<Puffs> casting;
    for (const System& system : systems_)
        if (castsShadow(system.picture->look())) casting.push_back(system.particles.store());
    sunlight_->shine(casting);
}

/// Particles of a system in the colours that they show.
Puffs PluginParticles::inLight(const System& system, const Puffs& puffs, const Frame& frame,
                               light::LitPuffs& lit) const {
    if (!sunlight_ || !scattersLight(system.picture->look())) return puffs;
    return sunlight_->on(puffs, frame.view.camera.eye, lit);
}

void PluginParticles::uploadSeen(System& system, const Frame& frame) {
    if (system.onGpu)
        return system.picture->gather(system.onGpu->buffers(), glm::vec3(frame.view.camera.eye), frame.clock);
    const auto stepSeconds = static_cast<float>(frame.stepSeconds);
    Puffs puffs;
    {
        const auto timing = frame.clock.measure(Stage::build);
        puffs = system.seen->of(system.particles.store(), frame.view, system.picture->look(), stepSeconds, sight_);
        puffs = inLight(system, puffs, frame, system.lit);
    }
    system.picture->upload({puffs, glm::vec3(frame.view.camera.eye), stepSeconds}, frame.clock);
}

void PluginParticles::uploadMarks(System& system) {
    std::vector<particles::Mark> marks;
    for (const particles::Part* part : system.particles.parts().all())
        if (const auto mark = part->mark()) marks.push_back(*mark);
    if (marks.empty() && !system.marks) return;
    if (!system.marks) system.marks = std::make_unique<MarkPass>(*device_, scene_->lights);
    system.marks->upload(marks);
}

void PluginParticles::update(const Frame& frame) {
    applyChanges(frame);
    carryEvents();
    {
        const auto timing = frame.clock.measure(Stage::simulate);
        for (System& system : systems_) {
            const particles::Surroundings around{.scene = *scene_,
                                                 .state = frame.state,
                                                 .stepSeconds = frame.stepSeconds,
                                                 .fixedCount = system.fixedCount,
                                                 .view = &frame.view};
            if (system.onGpu)
                system.onGpu->update(around);
            else
                system.particles.update(around);
        }
        now_ = frame.state;
        findLights();
        shine();
    }
    for (System& system : systems_) uploadMarks(system);
    for (System& system : systems_) uploadSeen(system, frame);
    uploadedFor_ = frame.view;
}

void PluginParticles::draw(const Frame& frame, gpu::Layer& layer) {
    // A paused window may draw the same state from elsewhere, where other particles are in sight.
    if (!isSame(frame.view, uploadedFor_)) {
        for (System& system : systems_)
            if (dependsOnView(system.picture->look(), sight_)) uploadSeen(system, frame);
        uploadedFor_ = frame.view;
    }
    for (System& system : systems_)
        if (system.marks) system.marks->draw(frame.view, layer);
    for (System& system : systems_) system.picture->draw(frame.view, layer);
}

void PluginParticles::volume(const Frame& frame, VolumeVisitor& visitor) const {
    for (const System& system : systems_) {
        light::LitPuffs lit;
        if (system.onGpu)
            visitor.puffs(system.onGpu->readBack());
        else
            visitor.puffs(inLight(system, system.particles.store(), frame, lit));
    }
}

void PluginParticles::report(const Frame&, Facts& facts) const {
    std::int64_t all = 0;
    for (std::size_t i = 0; i < systems_.size(); ++i) {
        const System& system = systems_[i];
        const auto alive =
            static_cast<std::int64_t>(system.onGpu ? system.onGpu->count() : system.particles.store().size());
        if (i < countedSystems) facts.set(aliveFact(i), alive);
        all += alive;
    }
    facts.set("alive_max", all);
    if (askedFor_ > 0)
        facts.set("alive_deviation", static_cast<double>(all - askedFor_) / std::sqrt(static_cast<double>(askedFor_)));
    facts.set("systems", static_cast<std::int64_t>(systems_.size()));
}

MemoryReport PluginParticles::memory() const {
    MemoryReport report;
    for (const System& system : systems_)
        for (const MemoryReport& part :
             {system.onGpu ? system.onGpu->memory() : system.particles.memory(), system.picture->memory()})
            for (const MemoryUse& use : part)
                report.push_back({system.name + ": " + use.structure, use.cpuBytes, use.gpuBytes});
    std::size_t seen = 0;
    for (const System& system : systems_) seen += system.seen->bytes();
    if (seen > 0) report.push_back({"particles in sight", seen, 0});
    if (sunlight_) {
        std::size_t bytes = sunlight_->bytes();
        for (const System& system : systems_) bytes += system.lit.bytes();
        report.push_back({"sunlight", bytes, 0});
    }
    return report;
}

std::int64_t PluginParticles::primitives() const {
    std::size_t sum = 0;
    for (const System& system : systems_) sum += system.onGpu ? system.onGpu->count() : system.picture->count();
    return static_cast<std::int64_t>(sum);
}

std::optional<std::uint64_t> PluginParticles::stateHash() const {
    std::vector<std::uint64_t> hashes;
    hashes.reserve(systems_.size());
    for (const System& system : systems_)
        hashes.push_back(system.onGpu ? system.onGpu->readBack().hash() : system.particles.stateHash());
    return particles::stateHash(now_, hashes);
}

std::vector<KeptFile> PluginParticles::files() const {
    std::vector<particles::NamedPartsView> views;
    views.reserve(systems_.size());
    for (const System& system : systems_) views.push_back({system.name, system.particles.parts()});
    return {{"systems.toml", particles::systemsToToml(views)}};
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Plugin particles";
    info.summary = "Particle systems assembled from parts: sources, velocities, forces, colours and ways to draw.";
    info.source = "Thesis";
    info.parameters.dataFile("system", "wheel_dust", "particles", ".toml", systemNames(),
                             "file with one or more particle systems to simulate and draw");
    info.parameters.real("size_factor", 1, 1e-3, 1e3, "", "factor on the sizes of all particles");
    info.parameters.boolean("culling", false, "leaves out particles that are out of sight; the picture stays the same");
    info.parameters.real("detail_pixels", 0, 0, 64, "pixels",
                         "thins out particles whose radius covers less, and enlarges the others to it; 0: draws all");
    info.parameters.choice("storage", "file", storageWords(),
                           "how systems keep their particles; array: in columns; list: in a linked list; pool: in a "
                           "linked list that keeps the nodes of the dead; file: as the file says, or array");
    info.parameters.choice(
        "systems_on", SystemsOn::cpu, systemsOnWords,
        "processor that steps and draws the systems; gpu: in compute shaders, for parts that have one");
    info.parameters.changes("at",
                            "changes to parts and their parameters during the run: 2.5s:velocity.speed=8, "
                            "1s:velocity.part=cone; with several systems: 2s:smoke.velocity.speed=8");
    for (std::size_t i = 0; i < countedSystems; ++i)
        info.facts.push_back({aliveFact(i), "particles", FactOver::lastFrame,
                              "particles alive in system " + std::to_string(i + 1) +
                                  " of the file after the last frame; empty if there are fewer systems"});
    info.facts.push_back({"alive_max", "particles", FactOver::maximumOfFrames,
                          "particles alive in all systems of the file: maximum of the recorded frames"});
    info.facts.push_back({"alive_deviation",
                          "1",
                          FactOver::lastFrame,
                          "particles alive in all systems of the file after the last frame minus the requested number, "
                          "divided by its square root; empty if no number was requested",
                          {-5, 5}});
    info.facts.push_back({"systems", "systems", FactOver::lastFrame, "particle systems in the file"});
    info.takesLights = true;
    info.takesGpuDust = [](const ParameterValues&) { return true; };  // it does not show the shared dust
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<PluginParticles>(
            systemsOf(values), values.changes("at"),
            Sight{values.boolean("culling"), static_cast<float>(values.real("detail_pixels"))},
            values.choice("systems_on", systemsOnWords));
    };
    return info;
}

}  // namespace dustbench::plugin_particles
