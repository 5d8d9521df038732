// Billboards drawn into a picture of half or quarter resolution, which is then enlarged over the scene. At depth edges,
// where enlarging would carry dust across a silhouette, they are drawn again at full resolution.
//
// Source: Cantlay2007. Departs: a texel has the farthest depth of its pixels, as there, but an edge is a pixel whose
// depth differs by more than a tenth from one of the four texels around it. The depth buffer of the pass at full
// resolution selects these pixels instead of a stencil. `upsampling=depth` is ours: the bilinear mean of the texels on
// the pixel's own surface. Puffs are those of draw/billboards.h, with the optical model's opacity.
#pragma once

#include <optional>
#include <span>

#include "methods/contract/method.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/draw/gpu_depth_order.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::offscreen_particles {

inline constexpr Choices<int> scales{{"2", 2}, {"4", 4}};

enum class Upsampling {
    depth,     ///< bilinear among the texels on the pixel's own surface
    bilinear,  ///< carries dust across edges
    nearest,
};
inline constexpr Choices<Upsampling> upsamplings{
    {"depth", Upsampling::depth}, {"bilinear", Upsampling::bilinear}, {"nearest", Upsampling::nearest}};

enum class Edges {
    mixed,  ///< drawn again at full resolution
    none,   ///< enlarged like all other pixels
};
inline constexpr Choices<Edges> edgeKinds{{"mixed", Edges::mixed}, {"none", Edges::none}};

struct Settings {
    int scale = 2;  ///< pixels per texel of the small picture, along each side
    Upsampling upsampling = Upsampling::depth;
    Edges edges = Edges::mixed;
};

/// A layer over a depth buffer of its own. Owns: both.
class Target {
 public:
    Target(gpu::Device& device, std::string_view label, int width, int height, gpu::Format format);
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    /// Clears the colour and fills the depth by a fragment program over the whole image.
    void begin(const gpu::Program& depthProgram, const gpu::VertexArray& noVertices);
    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }
    [[nodiscard]] const gpu::Layer& layer() const { return layer_; }
    [[nodiscard]] std::size_t gpuBytes() const { return depth_.bytes() + layer_.colour().bytes(); }

 private:
    gpu::Texture depth_;
    gpu::Framebuffer depthOnly_;
    gpu::Layer layer_;
};

class OffscreenParticles final : public Method {
 public:
    explicit OffscreenParticles(const Settings& settings) : settings_(settings), sort_(ledger_) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    void updateOnGpu(const Frame& frame);
    void fit(const gpu::Layer& layer);
    void upload(const Puffs& dust, std::span<const std::uint32_t> order);
    [[nodiscard]] std::size_t targetBytes() const;

    Settings settings_;
    MemoryLedger ledger_;
    draw::DepthSort sort_;
    gpu::Device* device_ = nullptr;
    gpu::Program shrinkDepth_, edgeDepth_, upsample_;
    std::optional<gpu::VertexArray> noVertices_;
    std::optional<draw::Billboards> quads_;
    std::optional<draw::GpuDepthOrder> gpuOrder_;  ///< made for the first dust on the GPU
    std::optional<Target> small_, edges_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::offscreen_particles
