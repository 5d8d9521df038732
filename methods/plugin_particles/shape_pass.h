// How one primitive is uploaded and drawn; a system's picture uses the pass that its render part selects.
//
// Owns: the instances, on the GPU. Threads: the OpenGL thread. Source: Thesis, 4.1.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/render_part.h"

namespace dustbench::plugin_particles {

/// Particles to draw. `order` is empty if any order will do.
struct Drawn {
    const Puffs& puffs;
    std::span<const std::uint32_t> order;
    float stepSeconds;

    /// Returns the path of particle `i` over the last `seconds` (0: a step), at most since its birth: straight along
    /// its velocity, which is exact for a step without a collision.
    [[nodiscard]] glm::vec3 wayOf(std::size_t i, float seconds) const {
        const float lasted = std::min(seconds > 0 ? seconds : stepSeconds, puffs.age[i]);
        return lasted * glm::vec3(puffs.velocityX[i], puffs.velocityY[i], puffs.velocityZ[i]);
    }
};

class ShapePass {
 public:
    virtual ~ShapePass() = default;
    virtual void upload(const Drawn& drawn) = 0;
    /// The same for particles on the GPU, in their order or that of the indices in `order`; only for a look that
    /// `drawsFromGpu`.
    virtual void gather(const GpuPuffs& puffs, const gpu::Buffer* order);
    /// Draws the last upload into `layer`; may be called repeatedly.
    virtual void draw(const scene::View& view, const gpu::Layer& layer) = 0;
    /// Number of primitives that a `draw` submits.
    [[nodiscard]] virtual std::size_t count() const = 0;
    [[nodiscard]] virtual std::size_t gpuBytes() const = 0;
    /// Memory of the data that the pass keeps between uploads.
    [[nodiscard]] virtual std::size_t cpuBytes() const { return 0; }
};

/// Whether particles of this look can be drawn from GPU buffers: puffs, and sprites without a picture.
[[nodiscard]] bool drawsFromGpu(const particles::Look& look);

/// Throws InputError if the look's picture or mesh cannot be read.
[[nodiscard]] std::unique_ptr<ShapePass> makePass(gpu::Device& device, const particles::Look& look,
                                                  const scene::Lights& lights);

/// Calls `put(value, i)` for each particle `i` in drawing order; `value` points to the particle's floats in the buffer.
template <typename Put>
void fill(std::span<float> memory, std::size_t floats, const Drawn& drawn, const Put& put) {
    parallel::forEachBlock(drawn.puffs.size(), 16'384, [&](std::size_t first, std::size_t count) {
        float* value = memory.data() + first * floats;
        for (std::size_t place = first; place < first + count; ++place, value += floats)
            put(value, drawn.order.empty() ? place : drawn.order[place]);
    });
}

}  // namespace dustbench::plugin_particles
