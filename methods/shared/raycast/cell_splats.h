// Each cell with density as a Gaussian that faces the eye, blended from the farthest to the nearest.
//
// A splat has the mass of its cell and the optical depth across it: s = edge/√(2π), τ = σ·edge. So small and so near to
// each other they make an even cloud, to a tenth of its extinction.
//
// Units: metres. Frame: world. Owns: the cells to draw, booked on a ledger, and the splats on the GPU. Threads: the
// OpenGL thread's. Source: Senger2009, ch. 2.
#pragma once

#include <cstddef>
#include <vector>

#include "methods/shared/draw/billboards.h"
#include "methods/shared/draw/depth_sort.h"
#include "methods/shared/raycast/light_volume.h"
#include "methods/shared/raycast/raycast_settings.h"
#include "methods/shared/raycast/shown_grid.h"

namespace dustbench::raycast {

class CellSplats {
 public:
    CellSplats(gpu::Device& device, const RaycastSettings& settings, MemoryLedger& ledger);

    /// `light`: null where the cloud casts no shadow on itself; else each cell has the light of the texel it lies in.
    void upload(const ShownGrid& grid, const Reflected& reflected, const LightVolume* light);
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t count() const { return x_.size(); }
    [[nodiscard]] std::size_t gpuBytes() const { return billboards_.gpuBytes(); }

 private:
    RaycastSettings settings_;
    std::vector<glm::vec4> fire_;
    draw::Billboards billboards_;
    draw::DepthSort sort_;
    LedgerVector<float> x_, y_, z_, opacity_;
    LedgerVector<glm::vec3> colours_;  ///< empty where all have the same
    glm::vec3 colourOfAll_{0};
    float radiusMetres_ = 0;
};

}  // namespace dustbench::raycast
