// One method shown in one world: its graphics, its memory and its facts. The world is stepped by others, so that
// several hosts can show the same moment of it.
//
// Owns: the method, the picture's targets and the ledger of all GPU memory behind them. Threads: the device's.
#pragma once

#include <cstdint>
#include <memory>

#include "bench/reference/judge/moment_pictures.h"
#include "bench/results/run_record.h"
#include "bench/scene/world.h"
#include "methods/contract/method.h"
#include "methods/kit/draw/composite.h"
#include "methods/kit/draw/opaque_scene.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

class MethodHost {
 public:
    /// Prepares the method for the world. `world`, `device` and `info` must outlive the host.
    MethodHost(const World& world, gpu::Device& device, const MethodInfo& info, const ParameterValues& parameters,
               int width, int height);

    /// The world's moment as the method sees it: valid until the next call or step. `clock` must outlive it.
    [[nodiscard]] Frame see(std::int64_t index, const StageClock& clock);
    void update(const Frame& frame);
    /// The opaque scene, the method over it, and the two composed; reported as the stages `scene` and `draw`.
    void draw(const Frame& frame);

    /// What the last `draw` left, linear: the method's layer, and the composed picture as it would be shown.
    [[nodiscard]] pictures::Image layer() const;
    [[nodiscard]] pictures::Image result() const;
    /// The layer over its scene, linear.
    [[nodiscard]] pictures::Image picture() const;
    /// Draws the moment apart from all that is timed. `withDetail`: the layer without the scene as well.
    [[nodiscard]] DrawnMoment drawn(const Frame& frame, bool withDetail);

    /// Keeps those facts whose maximum over all recorded frames counts. After a recorded frame, untimed.
    void keepFacts(const Frame& frame);
    /// All facts that the method told, by column; those of the last frame are asked for now.
    [[nodiscard]] Columns facts(const Frame& lastFrame);

    [[nodiscard]] const Method& method() const { return *method_; }
    [[nodiscard]] std::int64_t cpuBytes() const;
    [[nodiscard]] std::int64_t gpuBytes() const { return static_cast<std::int64_t>(ledger_.totalBytes()); }
    /// GPU bytes by structure.
    [[nodiscard]] const MemoryLedger& gpuLedger() const { return ledger_; }

 private:
    const World& world_;
    gpu::Device& device_;
    const MethodInfo& info_;
    MemoryLedger ledger_;
    std::unique_ptr<Method> method_;
    std::unique_ptr<draw::OpaqueScene> scene_;
    std::unique_ptr<gpu::Layer> layer_;
    std::unique_ptr<draw::Composite> composite_;
    gpu::Texture noScene_;  ///< a depth image of nothing; made when first wanted
    int width_, height_;
    scene::View view_{};
    Facts ofFrame_;
    std::vector<std::optional<FactValue>> maxima_;  ///< by place in info_.facts
};

}  // namespace dustbench::bench
