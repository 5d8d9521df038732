// Particle systems assembled from parts: one or several named systems, each with its own simulation.
//
// The systems are stepped and drawn in the order of their file, each drawn over the previous ones; they interact
// only by events (kit/particles/events.h). With the harness's `particles=N` they share N evenly. With `wheel_dust`
// the state equals that of the shared dust, bit by bit. Parts and their parameters may change during a run
// (kit/particles/part_list.h); with several systems, a change's name begins with the system's. Source: Thesis, 3
// (design), 4.1 (rendering). Departs: a structure of arrays unless a system chooses linked lists
// (kit/particles/particle_store.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/method.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_system.h"
#include "methods/kit/particles_gl/gpu_system.h"
#include "methods/plugin_particles/mark_pass.h"
#include "methods/plugin_particles/seen_particles.h"
#include "methods/plugin_particles/sunlight.h"
#include "methods/plugin_particles/system_picture.h"

namespace dustbench::plugin_particles {

/// The processor that steps the systems.
enum class SystemsOn { cpu, gpu };
inline constexpr Choices<SystemsOn> systemsOnWords{{"cpu", SystemsOn::cpu}, {"gpu", SystemsOn::gpu}};

class PluginParticles final : public Method {
 public:
    /// Takes one or more systems. `changes`: sorted by time. `sight`: which particles are drawn. Throws InputError if a
    /// change will be impossible at its time, or an event names a system that does not exist.
    explicit PluginParticles(std::vector<particles::NamedParts> systems, std::vector<Change> changes = {},
                             const Sight& sight = {}, SystemsOn processor = SystemsOn::cpu);

    /// Throws InputError if fewer particles are requested than there are systems, or any number with events that start
    /// particles; on the GPU, if a part has no shader or the systems are used in a way that needs them on the CPU.
    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;
    [[nodiscard]] std::optional<std::uint64_t> stateHash() const override;
    /// The lights of the systems with a part `glow`, in order.
    [[nodiscard]] std::vector<scene::PointLight> lights() const override { return lights_; }
    [[nodiscard]] Puffs shadowing() const override { return sunlight_ ? sunlight_->casting() : Puffs{}; }
    [[nodiscard]] bool wantsPreroll() const override { return true; }
    /// Returns `systems.toml`: the current systems. Loading it gives the same parts.
    [[nodiscard]] std::vector<KeptFile> files() const override;

 private:
    struct System {
        std::string name;
        particles::ParticleSystem particles;
        std::int64_t fixedCount = 0;
        std::string shownAs{};  ///< the render part of `picture`
        std::unique_ptr<SystemPicture> picture{};
        std::unique_ptr<SeenParticles> seen = std::make_unique<SeenParticles>();
        light::LitPuffs lit{};                          ///< colours in sunlight
        std::unique_ptr<MarkPass> marks{};              ///< null: no part is drawn
        std::unique_ptr<particles::GpuSystem> onGpu{};  ///< of SystemsOn::gpu; replaces `particles`, with its parts
    };

    void moveToGpu(std::uint64_t seed);
    void applyChanges(const Frame& frame);
    void carryEvents();
    void makePicture(System& system);
    void findLights();
    void shine();
    [[nodiscard]] Puffs inLight(const System& system, const Puffs& puffs, const Frame& frame,
                                light::LitPuffs& lit) const;
    void uploadSeen(System& system, const Frame& frame);
    void uploadMarks(System& system);

    std::vector<particles::NamedParts> parts_;  ///< until `prepare`
    std::int64_t askedFor_ = 0;                 ///< number of particles; 0: as in the file
    std::vector<Change> changes_;
    std::size_t applied_ = 0;  ///< number of changes applied
    Sight sight_;
    SystemsOn processor_;
    scene::View uploadedFor_;
    std::vector<System> systems_;
    const scene::Scene* scene_ = nullptr;
    gpu::Device* device_ = nullptr;
    scene::SceneState now_;
    std::vector<scene::PointLight> lights_;
    std::unique_ptr<Sunlight> sunlight_;  ///< null unless scene::Lights::onDust
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::plugin_particles
