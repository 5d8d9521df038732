// Draws billboards per tile in a compute shader: the same layer as Billboards::draw, without a rasteriser.
//
// Each tile of the picture gets the billboards that cover it (TileLists), in their order; an invocation for each pixel
// blends them from the nearest to the farthest. Corners are placed in steps of 1/256 pixel, as rasterisers do.
//
// Units: m. Frame: world. Colours: linear RGB. Owns: lists of tiles, on the GPU. Threads: the OpenGL thread.
// Departs from the hardware: a layer of half floats is rounded once, not after each billboard.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/stage_clock.h"
#include "methods/contract/view.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/loop_limit.h"
#include "methods/kit/draw/tile_lists.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::draw {

class DUSTBENCH_API TileBillboards {
 public:
    /// Throws std::invalid_argument for a style with moving, additive or noisy billboards.
    TileBillboards(gpu::Device& device, const BillboardStyle& style);

    /// Replaces the layer where there are billboards. `billboards` have the style of this and no pictures. Details of
    /// the stage: `bin`, the lists of tiles; `blend`.
    void draw(const Billboards& billboards, const scene::View& view, const glm::vec3& colourOfAll,
              const gpu::Layer& layer, const StageClock& clock);
    /// As LoopLimit's.
    void requireWholeLoops(std::string_view method) const { loops_.requireWholeLoops(method); }
    [[nodiscard]] std::size_t bytes() const { return lists_.bytes(); }

 private:
    void prepare(gpu::Program& program, const Billboards& billboards, const scene::View& view) const;

    TileLists lists_;
    gpu::Program blend_;
    LoopLimit loops_;
};

}  // namespace dustbench::draw
