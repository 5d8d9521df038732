// Hosts one method in one world: its graphics, memory and facts, and the place where the shared dust is simulated. The
// world is stepped by the caller, so several hosts can show the same moment.
//
// Owns: the method, the picture's targets and the ledger of all GPU memory behind them. Threads: the device's.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bench/measure/provenance.h"
#include "bench/reference/judge/moment_pictures.h"
#include "bench/results/run_record.h"
#include "bench/results/run_spec.h"
#include "bench/world/world.h"
#include "methods/contract/method.h"
#include "methods/kit/draw/layer_blend.h"
#include "methods/kit/draw/opaque_scene.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::run {

/// Why the method cannot show this scene, its lights included; empty if it can.
[[nodiscard]] std::string whyNotTaken(const MethodInfo& method, const scene::Scene& scene);

/// Whether the method takes the dust in GPU buffers, with these parameters.
[[nodiscard]] bool takesGpuDust(const MethodInfo& method, const ParameterValues& parameters);

class MethodHost {
 public:
    /// Prepares the method for the world. `world`, `device` and `info` must outlive the host.
    MethodHost(const world::World& world, gpu::Device& device, const MethodInfo& info,
               const ParameterValues& parameters, int width, int height);

    /// Sets the size of the pictures. Does not change the state of the method.
    void resize(int width, int height);

    /// The current state of the world as the method sees it. Valid until the next call or step; `clock` must outlive
    /// it. Reads dust on the GPU back for methods that do not take it there, in the stage `upload`.
    [[nodiscard]] Frame see(std::int64_t index, const StageClock& clock);
    /// The same with the particles on the CPU, for Method::volume and for facts of the last frame.
    [[nodiscard]] Frame seeParticles(std::int64_t index, const StageClock& clock);
    void update(const Frame& frame);
    /// Draws the opaque scene and the method and composes them; reported as the stages `scene` and `draw`.
    void draw(const Frame& frame);

    /// Results of the last `draw`, linear: the method's layer, and the composed picture as it would be displayed.
    [[nodiscard]] pictures::Image layer() const;
    [[nodiscard]] pictures::Image result() const;
    /// The composed picture of the last `draw`, display-encoded. Valid for the lifetime of the host.
    [[nodiscard]] const gpu::Texture& display() const { return composite_->result(); }
    /// The parts of the picture, linear: the opaque scene with its reversed depth, and the premultiplied layer.
    [[nodiscard]] const gpu::Texture& sceneColour() const { return scene_->colour(); }
    [[nodiscard]] const gpu::Texture& sceneDepth() const { return scene_->depth(); }
    [[nodiscard]] const gpu::Texture& layerColour() const { return layer_->colour(); }
    /// The layer over its scene, linear.
    [[nodiscard]] pictures::Image picture() const;
    /// Draws the frame outside all timing. `withDetail`: also draws the layer without the scene.
    [[nodiscard]] reference::DrawnMoment drawn(const Frame& frame, bool withDetail);

    /// Updates the facts that are maxima over all recorded frames, unless the method reports them at the end. Call
    /// after a recorded frame, untimed.
    void keepFacts(const Frame& frame);
    /// All facts that the method reports, by column; facts of the last frame are queried now.
    [[nodiscard]] results::Columns facts(const Frame& lastFrame);

    [[nodiscard]] const Method& method() const { return *method_; }
    /// Primitives of the last `draw`. May read back their number, or that of particles.
    [[nodiscard]] std::int64_t primitives() const;
    [[nodiscard]] std::int64_t cpuBytes() const;
    [[nodiscard]] std::int64_t gpuBytes() const { return static_cast<std::int64_t>(ledger_.totalBytes()); }
    /// GPU bytes by structure.
    [[nodiscard]] const MemoryLedger& gpuLedger() const { return ledger_; }

 private:
    void keepMaxima(const Frame& frame);

    const world::World& world_;
    gpu::Device& device_;
    const MethodInfo& info_;
    MemoryLedger ledger_;
    std::unique_ptr<Method> method_;
    std::unique_ptr<draw::OpaqueScene> scene_;
    std::unique_ptr<gpu::Layer> layer_;
    std::unique_ptr<draw::Composite> composite_;
    gpu::Texture noScene_;  ///< an empty depth image, created on first use
    int width_, height_;
    bool takesGpuDust_;
    /// False for a method with its own simulation, which does not show the shared dust.
    bool dustThrowsShadow_ = false;
    scene::View view_{};
    Facts ofFrame_;
    std::vector<std::optional<FactValue>> maxima_;  ///< by index in info_.facts
};

/// Throws InputError, which names what has no shader, if the run requests the GPU for dust that cannot live there.
void requireDustPlace(const results::RunSpec& spec, const world::World& world);

/// Moves the dust to the device if the run requests it; `auto`: if the device is hardware and the dust can live there.
/// Call before the first step. Returns the choice and the reason: `gpu` and `hardware device`.
measure::DustPlace placeDust(const results::RunSpec& spec, world::World& world, gpu::Device& device);

/// The warning of a run whose method needs the dust read back; empty for other methods.
[[nodiscard]] std::string readBackWarning(const world::World& world, const MethodInfo& info,
                                          const ParameterValues& parameters);

}  // namespace dustbench::run
