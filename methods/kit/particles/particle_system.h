// A particle system: a store, and the parts that simulate its particles. Saved as and loaded from TOML.
//
// Source: Thesis, 3.1.3 and 3.3.2 (nine kinds of part; the order of an update).
// Threads: `update` uses the current oneTBB arena; results are bit-identical at any number of threads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/kit/particles/part_list.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles {

/// The state of the world during one step.
struct Surroundings {
    const scene::Scene& scene;
    const scene::SceneState& state;  ///< at the end of the step
    double stepSeconds = 1.0 / 60;
    /// Mean number of living particles to maintain; 0: the emission's own rate. (The harness's `particles=N`.)
    std::int64_t fixedCount = 0;
    /// Particles born instead of each one, evenly in time; 1 or more. (Above 1: the ground truth's `continuum`, whose
    /// particles count for proportionally less.)
    std::int64_t particlesPerPuff = 1;
    /// Of the camera; null for dust that several methods share.
    const scene::View* view = nullptr;
};

class DUSTBENCH_API ParticleSystem {
 public:
    /// Throws InputError with file, line and what was expected.
    static ParticleSystem load(const std::filesystem::path& file, std::uint64_t seed);

    /// Throws InputError if the list is incomplete.
    explicit ParticleSystem(std::unique_ptr<PartList> parts, std::uint64_t seed);
    ParticleSystem(ParticleSystem&&) noexcept;
    ParticleSystem& operator=(ParticleSystem&&) noexcept;
    ~ParticleSystem();

    /// One step: acceleration 0, age, life, colour, shading, size, forces, integration, emission.
    /// Particles born within the step are advanced by the remainder of the step.
    void update(const Surroundings& surroundings);

    /// The system as TOML; loading the text gives the same system.
    [[nodiscard]] std::string toToml() const;

    [[nodiscard]] const ParticleStore& store() const;
    /// For replacing parts between updates.
    [[nodiscard]] PartList& parts();
    [[nodiscard]] const PartList& parts() const;
    /// Continues with other parts from the next update on. With the same parts, as after saving and loading, it
    /// continues as if nothing had happened. Throws InputError if the list is incomplete.
    void replaceParts(std::unique_ptr<PartList> parts);
    [[nodiscard]] double meanLifetimeSeconds() const;
    /// By event part: the events of the last update.
    [[nodiscard]] std::span<const std::vector<Event>> events() const;
    /// A number in [0, 1) for an event of the last update: by chance, from the seed.
    [[nodiscard]] float chanceOf(std::uint64_t serial, std::uint32_t eventPart) const;
    /// `count` births at the beginning of the next update, shared evenly by `emitters`; empty: those of the position
    /// part.
    void start(std::int64_t count, std::vector<Emitter> emitters);
    /// False: no births of the emission from the next update on; its clock stands still.
    void emit(bool emits);
    /// Hash of every particle's state, in storage order.
    [[nodiscard]] std::uint64_t stateHash() const;
    [[nodiscard]] MemoryReport memory() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The hash of a whole simulation: time, vehicle, moving solids and systems. The world and methods use the same
/// function, so equal hashes mean equal states. `systems`: ParticleSystem::stateHash of each, in their order.
[[nodiscard]] DUSTBENCH_API std::uint64_t stateHash(const scene::SceneState& state,
                                                    std::span<const std::uint64_t> systems);

}  // namespace dustbench::particles
