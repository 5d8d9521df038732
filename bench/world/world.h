// A scene with its vehicle, drive and dust, stepped at a fixed rate: the input of every method.
//
// Units: SI. Threads: one at a time; the dust uses the current oneTBB arena.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/world/cameras.h"
#include "bench/world/control_source.h"
#include "bench/world/given_dust.h"
#include "bench/world/time_step.h"
#include "methods/contract/memory_report.h"
#include "methods/contract/method.h"
#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"
#include "methods/contract/volume.h"

namespace dustbench::gpu {
class Device;
}  // namespace dustbench::gpu

namespace dustbench::world {

struct SceneFile;

/// The parameters of the world itself, the same for every method: `particles`, `puffs_per_metre`, `speed`, `preroll`, …
[[nodiscard]] const ParameterSet& worldParameters();

class World {
 public:
    /// `sceneId` and `driveId` are names of files in data/ or paths; an empty drive selects the scene's own. Each
    /// particle is replaced by `particlesPerPuff` (1 or more) particles, for the `continuum` reference. Throws
    /// InputError for any error in the files, std::invalid_argument for fewer than 1.
    World(const std::string& sceneId, const std::string& driveId, const ParameterValues& parameters, std::uint64_t seed,
          std::int64_t particlesPerPuff = 1);
    /// The same with controls from `source`; `driveId()` is empty, and the parameter `speed` has no effect.
    World(const std::string& sceneId, std::unique_ptr<ControlSource> source, const ParameterValues& parameters,
          std::uint64_t seed);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    [[nodiscard]] const scene::Scene& scene() const;
    [[nodiscard]] const scene::SceneState& state() const;
    /// The dust as methods show it; with `light=sun`, lit as the camera sees it, computed once per step. Valid until
    /// the next step or change of camera.
    [[nodiscard]] Puffs dust() const;
    /// The same with its colours without light. Valid until the next step.
    [[nodiscard]] Puffs unlitDust() const;
    [[nodiscard]] scene::View view(int width, int height) const;
    /// Sets the camera; nothing else changes. The initial camera is that of the parameter `camera`.
    void look(CameraKind camera);
    void follow(CameraPath path);
    /// follow() the rows or the file of a camera path (CameraPath::read), which then is one of the input files; an
    /// empty text changes nothing.
    void followPath(const std::string& fileOrRows);

    /// Uses particles from a file instead of the scene's own, from the first step on; an empty file name changes
    /// nothing. Its files become input files. The preroll is as long as with the scene's dust. Call before the first
    /// step. Throws InputError for an error in the files, if they end before the last frame, and if `particles`
    /// or `puffs_per_metre` is above 0.
    void useDust(const GivenDust& given);
    /// True if the dust is from a file.
    [[nodiscard]] bool hasGivenDust() const;

    /// Why this world's dust cannot live on the GPU, as `the part force 'boids'` or `light=sun`; empty if it can.
    [[nodiscard]] std::string whyDustStaysOnCpu() const;
    /// Simulates the dust on the GPU from now on. Then dust() and stateHash() read it back, which waits for the GPU.
    /// Call before the first step; `device` must outlive the world. Throws InputError with whyDustStaysOnCpu.
    void moveDustTo(gpu::Device& device);
    /// The dust in GPU buffers, valid until the next step; null if it is on the CPU.
    [[nodiscard]] const GpuPuffs* gpuDust() const;

    /// The seed and the requested number of particles.
    [[nodiscard]] RunSetup setup() const;

    /// Number of steps of the untimed preroll, which builds up the cloud before recording begins.
    [[nodiscard]] std::int64_t prerollSteps() const;
    /// Length of the drive; after it the last row applies.
    [[nodiscard]] double driveSeconds() const;
    [[nodiscard]] const std::string& driveId() const;
    /// False if the scene is invisible.
    [[nodiscard]] bool isSceneDrawn() const;

    /// Gets the controls of the next step (stage `input`).
    void readInput();
    /// Controls of the last decision.
    [[nodiscard]] const Controls& controls() const;
    /// Advances the vehicle, then the dust, by one step (stage `simulate`).
    void simulate();
    /// readInput() and simulate().
    void step() {
        readInput();
        simulate();
    }

    /// Hash of vehicle and dust: the same for every method, thread count and build.
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

}  // namespace dustbench::world
