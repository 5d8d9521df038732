// A scene with its vehicle on its drive and its dust: what every method is shown, stepped at the fixed rate.
//
// Units: SI. Threads: one at a time; the dust uses the current oneTBB arena.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/scene/control_source.h"
#include "bench/scene/time_step.h"
#include "methods/contract/memory_report.h"
#include "methods/contract/method.h"
#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"
#include "methods/contract/volume.h"

namespace dustbench::bench {

struct SceneFile;

/// The parameters of the world itself, the same for every method: `particles`, `speed`, `preroll`, `camera`, …
[[nodiscard]] const ParameterSet& worldParameters();

class World {
 public:
    /// `sceneId` and `driveId` name files of data/ or are paths; an empty drive is the scene's own.
    /// `particlesPerPuff` (1 or more) particles are born in the place of each one, for the `continuum` reference.
    /// Throws InputError for whatever is wrong with the files, std::invalid_argument for fewer than 1.
    World(const std::string& sceneId, const std::string& driveId, const ParameterValues& parameters, std::uint64_t seed,
          std::int64_t particlesPerPuff = 1);
    /// The same with somebody else at the wheel; `driveId()` is empty, and the parameter `speed` has no effect.
    World(const std::string& sceneId, std::unique_ptr<ControlSource> source, const ParameterValues& parameters,
          std::uint64_t seed);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    [[nodiscard]] const scene::Scene& scene() const;
    [[nodiscard]] const scene::SceneState& state() const;
    /// Valid until the next step.
    [[nodiscard]] Puffs dust() const;
    [[nodiscard]] scene::View view(int width, int height) const;

    /// The seed, and the number of particles asked for.
    [[nodiscard]] RunSetup setup() const;

    /// Steps of the untimed preroll, so that the cloud is there when recording begins.
    [[nodiscard]] std::int64_t prerollSteps() const;
    /// Length of the drive; after it its last row holds.
    [[nodiscard]] double driveSeconds() const;
    [[nodiscard]] const std::string& driveId() const;

    /// The driver decides for the next step (stage `input`).
    void readInput();
    /// What was decided last.
    [[nodiscard]] const Controls& controls() const;
    /// Vehicle, then dust, one step on (stage `simulate`).
    void simulate();
    /// Both.
    void step() {
        readInput();
        simulate();
    }

    /// Of vehicle and dust: the same for every method, thread count and build.
    [[nodiscard]] std::uint64_t stateHash() const;
    [[nodiscard]] MemoryReport memory() const;
    /// Every file that the world was read from, for provenance.
    [[nodiscard]] std::vector<std::filesystem::path> inputFiles() const;

 private:
    struct State;
    void begin(SceneFile file, const std::string& drive, std::unique_ptr<ControlSource> source,
               const ParameterValues& parameters, std::uint64_t seed, std::int64_t particlesPerPuff);

    std::unique_ptr<State> state_;
};

}  // namespace dustbench::bench
