// One system's particles on the screen, as its render part says.
//
// Owns: the passes and the order of drawing. Threads: the OpenGL thread. Source: Thesis, 4.1.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "methods/contract/stage_clock.h"
#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/depth_sort.h"

namespace dustbench::plugin_particles {

class SystemPicture {
 public:
    explicit SystemPicture(gpu::Device& device);

    /// Sorts and uploads particles, as seen from `eye`.
    void upload(const Puffs& puffs, const glm::vec3& eye, const StageClock& clock);
    /// Draws what was uploaded last, as often as wanted.
    void draw(const scene::View& view, const gpu::Layer& layer);

    /// Primitives that the last `draw` submitted.
    [[nodiscard]] std::size_t count() const { return billboards_.count(); }
    [[nodiscard]] MemoryReport memory() const;

 private:
    MemoryLedger ledger_;
    draw::DepthSort sort_;
    draw::Billboards billboards_;
    glm::vec3 colourOfAll_{1};
};

}  // namespace dustbench::plugin_particles
