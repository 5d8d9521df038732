// Renders with the CPU march: reads back the scene's depths, marches, and composites the picture over the layer.
//
// Owns: the grid in the march's layout, and the picture on the GPU. Threads: the OpenGL thread; the march is parallel.
#pragma once

#include <memory>
#include <optional>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/raycast/cpu_march.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::raycast {

/// Composites a picture marched by the CPU over a layer. Owns the picture's GPU memory, which the CPU writes to.
class DUSTBENCH_API PacketComposite {
 public:
    explicit PacketComposite(gpu::Device& device)
        : device_(device), vertices_(device), programs_(std::make_shared<Programs>()) {}
    /// For another picture of the same frame: the two share their programs. They do not share memory, since the CPU
    /// writes to one while OpenGL still reads the other.
    PacketComposite(Beside, const PacketComposite& sibling)
        : device_(sibling.device_), vertices_(device_), programs_(sibling.programs_) {}

    /// A picture to fill; its values are write-only and valid until it is drawn.
    [[nodiscard]] PacketPicture map(const PixelRectangle& rectangle, int channels);
    /// Draws the picture mapped last. `reflected` is the colour of a picture that has only alpha.
    void draw(const glm::vec3& reflected, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const { return values_.bytes(); }

 private:
    /// Compiled on first use.
    struct Programs {
        std::optional<gpu::Program> alphaAlone, withColour;
    };

    gpu::Device& device_;
    gpu::Buffer values_;
    gpu::VertexArray vertices_;
    std::shared_ptr<Programs> programs_;
    PacketPicture picture_;
};

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
