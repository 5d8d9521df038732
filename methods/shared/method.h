// The contract between a method and the harness. `methods/README.md` is its manual page.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "methods/shared/memory_ledger.h"
#include "methods/shared/parameters.h"
#include "methods/shared/stage_clock.h"

namespace dustbench {

namespace gpu {
class Device;
class Layer;
}  // namespace gpu
namespace particles {
class ParticleStore;
}
namespace scene {
struct Scene;
struct SceneState;
struct View;
}  // namespace scene
class VolumeVisitor;

/// Everything of one moment that a method may look at. References are valid during the call alone.
struct Frame {
    std::int64_t index;                    ///< 0 is the first recorded frame; preroll and warm-up are negative
    double stepSeconds;                    ///< simulated time since the last frame
    const scene::SceneState& state;        ///< vehicle, wheels, solids, wind, camera, simulated time
    const particles::ParticleStore& dust;  ///< the shared dust: the very same particles for every method
    const scene::View& view;               ///< from where this frame will be drawn
    const StageClock& clock;               ///< where the method reports its stages
};

/// How wild a flow has been, the greatest of all steps so far.
struct FlowExtremes {
    double speedMetresPerSecond = 0;
    double cellsPerStep = 0;       ///< the Courant number
    double divergencePerStep = 0;  ///< the share of its volume that a cell gained in a step
};

/// One way to show the cloud. Prepared once; then `update` and `draw` each frame, on the thread that owns the OpenGL
/// context.
class Method {
 public:
    virtual ~Method() = default;

    /// Allocates. `scene` and `device` outlive the method. Throws InputError where parameters do not fit the scene.
    virtual void prepare(const scene::Scene& scene, gpu::Device& device) = 0;
    /// All that depends on the new state: build, sort, solve, upload. Not called for the preroll unless `wantsPreroll`.
    virtual void update(const Frame& frame) = 0;
    /// Premultiplied linear colour and alpha into `layer`: RGBA32F, cleared to 0, the opaque scene's depth beside it.
    /// Called once a frame, and again for untimed pictures of the same state; it must draw the same again.
    virtual void draw(const Frame& frame, gpu::Layer& layer) = 0;

    /// Hands over what the method thinks the cloud is after `update(frame)`, for export and metrics; never timed.
    /// Default: nothing to hand over.
    virtual void volume(const Frame&, VolumeVisitor&) const {}
    /// Particles of the last update that lay outside the method's world; empty where it has no bounds.
    [[nodiscard]] virtual std::optional<std::int64_t> clipped() const { return std::nullopt; }
    /// Share of the particles' optical mass that is left in the volume after `update(frame)`, never timed; empty where
    /// nothing can get lost.
    [[nodiscard]] virtual std::optional<double> massKept(const Frame&) const { return std::nullopt; }
    /// Bytes by structure, CPU and GPU, that the method holds now.
    [[nodiscard]] virtual MemoryReport memory() const { return {}; }
    /// How many primitives (billboards, voxels, rays …) the last `draw` handed to the GPU.
    [[nodiscard]] virtual std::int64_t primitives() const { return 0; }
    /// Hash of a simulation of the method's own; empty where it shows the shared dust alone.
    [[nodiscard]] virtual std::optional<std::uint64_t> stateHash() const { return std::nullopt; }
    /// Of a flow of the method's own, since the beginning; empty where nothing flows.
    [[nodiscard]] virtual std::optional<FlowExtremes> flow() const { return std::nullopt; }
    /// True for a method whose own simulation must run through the preroll and warm-up as well.
    [[nodiscard]] virtual bool wantsPreroll() const { return false; }
};

/// What a method folder tells of itself: its one function `MethodInfo describe()` in namespace dustbench::<folder>.
struct MethodInfo {
    std::string title;    ///< a few words: `Billboard dust`
    std::string summary;  ///< one sentence
    std::string source;   ///< key in data/references.bib, or empty
    ParameterSet parameters;
    std::function<std::unique_ptr<Method>(const ParameterValues&)> create;
    /// Why the method cannot take this scene (`needs a vehicle`), or empty: it can. Unset: it takes every scene.
    std::function<std::string(const scene::Scene&)> cannotTake;
    std::string id{};  ///< the folder's name; the registry fills it in
};

}  // namespace dustbench
