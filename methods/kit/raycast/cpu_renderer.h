// Renders with the CPU march: reads back the scene's depths, marches, and composites the picture over the layer.
//
// Owns: the grid in the march's layout, and the picture on the GPU. Threads: the OpenGL thread; the march is parallel.
#pragma once

#include "methods/kit/raycast/cpu_march.h"
#include "methods/kit/raycast/grid_renderer.h"
#include "methods/kit/raycast/packet_composite.h"

namespace dustbench::raycast {

class CpuRenderer final : public GridRenderer {
 public:
    CpuRenderer(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected, MemoryLedger& ledger);
    CpuRenderer(Beside, const CpuRenderer& sibling);

    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) override;
    std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                      SceneDepthCopy& sceneDepth) override;
    [[nodiscard]] std::unique_ptr<GridRenderer> another() const override;
    [[nodiscard]] std::size_t gpuBytes() const override { return composite_.gpuBytes(); }

 private:
    RaycastSettings settings_;
    Reflected reflected_;
    MemoryLedger& ledger_;
    CpuMarch march_;
    PacketComposite composite_;
};

}  // namespace dustbench::raycast
