// The contract between a method and the harness; methods/README.md is its manual.
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
class Buffer;
class Device;
class Layer;
}  // namespace gpu

/// The state of one frame as a method sees it. References and spans are valid during the call only.
struct Frame {
    std::int64_t index;              ///< 0 is the first recorded frame; preroll and warm-up are negative
    double stepSeconds;              ///< simulated time since the last frame
    const scene::SceneState& state;  ///< vehicle, wheels and simulated time
    Puffs dust;                      ///< the shared dust: the same particles for every method
    const scene::View& view;         ///< the view that this frame is drawn from
    const StageClock& clock;         ///< times the method's stages
    /// The shared dust in GPU buffers; null if it is on the CPU, or the method does not declare `takesGpuDust`. Then
    /// `dust` has no particles, only the colour of all; in Method::volume, and in Method::report after the last frame,
    /// it has them.
    const GpuPuffs* gpuDust = nullptr;
};

/// Settings of a run other than the method's parameters.
struct RunSetup {
    std::uint64_t seed = 1;      ///< seed of the run: the only source of randomness for a method
    std::int64_t particles = 0;  ///< requested load (`particles=N`); 0: set by the vehicle's speed
};

/// A text file that a run saves with its results.
struct KeptFile {
    std::string name;  ///< `systems.toml`
    std::string text;
};

/// Maximum number of lights that a method may return.
inline constexpr std::size_t maximumPointLights = 64;

/// One way to draw the cloud. `prepare` is called once, then `update` and `draw` each frame, on the thread that owns
/// the OpenGL context.
class DUSTBENCH_API Method {
 public:
    virtual ~Method();

    /// Allocates. `scene` and `device` outlive the method. Throws InputError if the parameters do not suit the scene.
    virtual void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) = 0;
    /// Does all work that depends on the new state: build, sort, solve, upload. Skipped in the preroll unless
    /// `wantsPreroll`.
    virtual void update(const Frame& frame) = 0;
    /// Draws premultiplied linear colour and alpha into `layer`: RGBA32F, cleared to 0, with the depth of the opaque
    /// scene. Called once per frame, and again for untimed pictures of the same state; repeated calls must draw the
    /// same picture.
    virtual void draw(const Frame& frame, gpu::Layer& layer) = 0;

    /// Passes the method's representation of the cloud after `update(frame)` to the visitor, for export and metrics.
    /// Never timed. The default passes nothing.
    virtual void volume(const Frame&, VolumeVisitor&) const {}
    /// Reports the declared facts of the state after `update(frame)`. Called after recorded frames; never timed.
    virtual void report(const Frame&, Facts&) const {}
    /// True if `report` would wait for the GPU. It is then called only after the last frame, and reports the maxima
    /// over all recorded frames.
    [[nodiscard]] virtual bool reportsAtEnd() const { return false; }
    /// CPU and GPU bytes held by the method, by structure.
    [[nodiscard]] virtual MemoryReport memory() const { return {}; }
    /// Number of primitives (billboards, voxels, rays …) that the last `draw` submitted to the GPU. −n: n for each puff
    /// of the shared dust, whose number only the GPU knows.
    static constexpr std::int64_t onePerPuff = -1;
    [[nodiscard]] virtual std::int64_t primitives() const { return 0; }
    /// If only the GPU knows that number: a buffer with it in the first word. `primitives` is then not called.
    [[nodiscard]] virtual const gpu::Buffer* primitiveCount() const { return nullptr; }
    /// Lights that the state after `update` casts on the opaque scene, such as a fire's. At most maximumPointLights.
    [[nodiscard]] virtual std::vector<scene::PointLight> lights() const { return {}; }
    /// With scene::Lights::onDust: the puffs of the method's own simulation, whose shadow falls on the opaque scene;
    /// valid until the next `update`. Ignored for methods without a `stateHash`, which show the shared dust.
    [[nodiscard]] virtual Puffs shadowing() const { return {}; }
    /// Hash of the method's own simulation; empty if it only shows the shared dust.
    [[nodiscard]] virtual std::optional<std::uint64_t> stateHash() const { return std::nullopt; }
    /// Files to save next to the run's run.json. Called once, after the last frame.
    [[nodiscard]] virtual std::vector<KeptFile> files() const { return {}; }
    /// True if the method's own simulation must also run during preroll and warm-up.
    [[nodiscard]] virtual bool wantsPreroll() const { return false; }
};

/// A method folder's description of itself, returned by `MethodInfo describe()` in namespace dustbench::<folder>.
struct MethodInfo {
    std::string title;    ///< a few words: `Billboard dust`
    std::string summary;  ///< one sentence
    std::string source;   ///< key in data/references.bib, or empty
    ParameterSet parameters;
    std::vector<FactInfo> facts;  ///< facts that `Method::report` reports
    bool drawsPanels = false;     ///< draws the scene's reliefs itself; for other methods the harness draws them flat
    bool takesLights = false;     ///< can draw dust lit by the scene's lights (Lights::onDust)
    /// Draws the dust from GPU buffers (Frame::gpuDust) with these parameters, or does not use it. For other methods
    /// the harness reads the buffers back, timed as `upload`. Unset: never.
    std::function<bool(const ParameterValues&)> takesGpuDust;
    std::function<std::unique_ptr<Method>(const ParameterValues&)> create;
    /// Returns why the method cannot draw this scene (`needs a vehicle`), or an empty text if it can. Unset: draws
    /// every scene.
    std::function<std::string(const scene::Scene&)> cannotTake;
    std::string id{};       ///< the folder's name; set by the registry
    std::string library{};  ///< the file that it was loaded from; empty for methods of this build; set by the registry
};

}  // namespace dustbench
