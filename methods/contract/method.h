// The contract between a method and the harness. `methods/README.md` is its manual page.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/facts.h"
#include "methods/contract/memory_report.h"
#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"
#include "methods/contract/stage_clock.h"
#include "methods/contract/view.h"
#include "methods/contract/volume.h"

namespace dustbench {

namespace gpu {
class Device;
class Layer;
}  // namespace gpu

/// Everything of one moment that a method may look at. References and spans are valid during the call alone.
struct Frame {
    std::int64_t index;              ///< 0 is the first recorded frame; preroll and warm-up are negative
    double stepSeconds;              ///< simulated time since the last frame
    const scene::SceneState& state;  ///< vehicle, wheels and simulated time
    Puffs dust;                      ///< the shared dust: the very same particles for every method
    const scene::View& view;         ///< from where this frame will be drawn
    const StageClock& clock;         ///< where the method reports its stages
};

/// What a run asks of a method beyond its parameters.
struct RunSetup {
    std::uint64_t seed = 1;      ///< the run's: all chance of a method's own comes from it
    std::int64_t particles = 0;  ///< the load asked for (`particles=N`); 0: as many as the vehicle's speed raises
};

/// One way to show the cloud. Prepared once; then `update` and `draw` each frame, on the thread that owns the OpenGL
/// context.
class DUSTBENCH_API Method {
 public:
    virtual ~Method();

    /// Allocates. `scene` and `device` outlive the method. Throws InputError where parameters do not fit the scene.
    virtual void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) = 0;
    /// All that depends on the new state: build, sort, solve, upload. Not called for the preroll unless `wantsPreroll`.
    virtual void update(const Frame& frame) = 0;
    /// Premultiplied linear colour and alpha into `layer`: RGBA32F, cleared to 0, the opaque scene's depth beside it.
    /// Called once a frame, and again for untimed pictures of the same state; it must draw the same again.
    virtual void draw(const Frame& frame, gpu::Layer& layer) = 0;

    /// Hands over what the method thinks the cloud is after `update(frame)`, for export and metrics; never timed.
    /// Default: nothing to hand over.
    virtual void volume(const Frame&, VolumeVisitor&) const {}
    /// Tells the declared facts of the state after `update(frame)`. Called after recorded frames, never timed.
    virtual void report(const Frame&, Facts&) const {}
    /// Bytes by structure, CPU and GPU, that the method holds now.
    [[nodiscard]] virtual MemoryReport memory() const { return {}; }
    /// How many primitives (billboards, voxels, rays …) the last `draw` handed to the GPU.
    [[nodiscard]] virtual std::int64_t primitives() const { return 0; }
    /// Hash of a simulation of the method's own; empty where it shows the shared dust alone.
    [[nodiscard]] virtual std::optional<std::uint64_t> stateHash() const { return std::nullopt; }
    /// True for a method whose own simulation must run through the preroll and warm-up as well.
    [[nodiscard]] virtual bool wantsPreroll() const { return false; }
};

/// What a method folder tells of itself: its one function `MethodInfo describe()` in namespace dustbench::<folder>.
struct MethodInfo {
    std::string title;    ///< a few words: `Billboard dust`
    std::string summary;  ///< one sentence
    std::string source;   ///< key in data/references.bib, or empty
    ParameterSet parameters;
    std::vector<FactInfo> facts;  ///< what `Method::report` tells
    bool drawsPanels = false;     ///< draws the scene's reliefs itself; for other methods the harness draws them flat
    bool takesLights = false;     ///< shows dust lit by the scene's lights
    std::function<std::unique_ptr<Method>(const ParameterValues&)> create;
    /// Why the method cannot take this scene (`needs a vehicle`), or empty: it can. Unset: it takes every scene.
    std::function<std::string(const scene::Scene&)> cannotTake;
    std::string id{};  ///< the folder's name; the registry fills it in
};

}  // namespace dustbench
