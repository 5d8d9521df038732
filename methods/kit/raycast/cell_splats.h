// Each cell with density as a Gaussian that faces the eye, blended from the farthest to the nearest.
//
// A splat has the mass of its cell and the optical depth across it: s = edge/√(2π), τ = σ·edge. So small and so near to
// each other they make an even cloud, to a tenth of its extinction.
//
// Units: metres. Frame: world. Owns: the cells to draw, booked on a ledger, and the splats on the GPU. Threads: the
// OpenGL thread's. Source: Senger2009, ch. 2.
#pragma once

#include <vector>

#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/raycast/grid_renderer.h"

namespace dustbench::raycast {

class CellSplats final : public GridRenderer {
 public:
    CellSplats(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected, MemoryLedger& ledger);

    /// Each cell has the light of the texel it lies in.
    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) override;
    std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer) override;

    [[nodiscard]] std::size_t gpuBytes() const override { return billboards_.gpuBytes(); }

 private:
    RaycastSettings settings_;
    Reflected reflected_;
    std::vector<glm::vec4> fire_;
    draw::Billboards billboards_;
    draw::DepthSort sort_;
    LedgerVector<float> x_, y_, z_, opacity_;
    LedgerVector<glm::vec3> colours_;  ///< empty where all have the same
    float radiusMetres_ = 0;
};

}  // namespace dustbench::raycast
