// Draws each cell with density as a Gaussian that faces the eye, blended far to near.
//
// A splat has the mass of its cell and the optical depth across it: s = edge/√(2π), τ = σ·edge. At this size and
// spacing, splats form a uniform cloud to within a tenth of its extinction.
//
// Units: metres. Frame: world. Owns: the cells to draw, booked on a ledger, and the splats on the GPU. Threads: the
// OpenGL thread. Source: Senger2009, ch. 2.
#pragma once

#include <vector>

#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::raycast {

class CellSplats final : public GridRenderer {
 public:
    CellSplats(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected, MemoryLedger& ledger);
    CellSplats(Beside, const CellSplats& sibling);

    /// Each cell takes the light of the texel that contains it.
    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) override;
    std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                      SceneDepthCopy& sceneDepth) override;
    [[nodiscard]] std::unique_ptr<GridRenderer> another() const override;

    /// Siblings share the splats on the GPU; the first of them counts them.
    [[nodiscard]] std::size_t gpuBytes() const override { return first_ ? billboards_->gpuBytes() : 0; }

 private:
    RaycastSettings settings_;
    Reflected reflected_;
    std::vector<glm::vec4> fire_;
    MemoryLedger& ledger_;
    std::shared_ptr<draw::Billboards> billboards_;
    bool first_ = true;
    draw::DepthSort sort_;
    LedgerVector<float> x_, y_, z_;  ///< from the grid's minimum corner
    LedgerVector<float> opticalDepth_;
    LedgerVector<glm::vec3> colours_;  ///< empty if all share one colour
    float radiusMetres_ = 0;
};

}  // namespace dustbench::raycast
