// Dust as sorted, camera-facing quads: the established method that the octree methods are compared with.
//
// Source: Carr2006, 3.1. `mode=paper` draws as the paper does: quicksort, one puff picture, opacity by age alone times
// the picture's alpha. Departs in `mode=fixed`: opacity follows the optical model shared by all methods
// (maths/transmittance.h). `puff` selects the paper's single puff picture, several pictures or an animation; `soft`
// fades quads out where they meet opaque surfaces; `noise` makes puffs uneven, which the paper names as future work.
// `raster=tiles` draws the same layer without the GPU's rasteriser.
#pragma once

#include <memory>
#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/age_opacity.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/draw/gpu_depth_order.h"
#include "methods/kit/draw/puff_noise.h"
#include "methods/kit/draw/puff_textures.h"
#include "methods/kit/draw/tile_billboards.h"

namespace dustbench::billboard {

enum class Puff { gaussian, texture, textures, animated };
inline constexpr Choices<Puff> puffs{{"gaussian", Puff::gaussian},
                                     {"texture", Puff::texture},
                                     {"textures", Puff::textures},
                                     {"animated", Puff::animated}};

/// How a quad's opacity follows from its picture.
enum class Alpha {
    optical,  ///< the picture is optical depth: Beer–Lambert law
    plain,    ///< the picture's alpha times the puff's opacity
};
inline constexpr Choices<Alpha> alphas{{"optical", Alpha::optical}, {"plain", Alpha::plain}};

/// What blends the billboards.
enum class Raster {
    hardware,  ///< the GPU's rasteriser and blending units
    tiles,     ///< a compute shader, tile by tile
};
inline constexpr Choices<Raster> rasters{{"hardware", Raster::hardware}, {"tiles", Raster::tiles}};

struct Settings {
    draw::SortKind sort = draw::SortKind::radix;
    Puff puff = Puff::gaussian;
    draw::OpacityFrom opacity = draw::OpacityFrom::dust;
    double youngOpacity = 0.5;
    draw::BillboardStyle style{};
    Raster raster = Raster::hardware;
    draw::NoiseSettings noise{};
};

class Billboard final : public Method {
 public:
    /// Throws InputError for pictures with `raster=tiles`.
    explicit Billboard(const Settings& settings);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] bool reportsAtEnd() const override { return true; }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    void updateOnGpu(const Frame& frame);
    void upload(const Puffs& dust, std::span<const float> opacity, std::span<const std::uint32_t> order);

    Settings settings_;
    MemoryLedger ledger_;
    draw::DepthSort sort_;
    std::optional<draw::AgeOpacity> byAge_;
    std::optional<draw::PuffTextures> pictures_;
    std::optional<draw::Billboards> quads_;
    std::optional<draw::TileBillboards> tiles_;    ///< if `raster` is tiles
    std::optional<draw::GpuDepthOrder> gpuOrder_;  ///< made for the first dust on the GPU
    gpu::Device* device_ = nullptr;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::billboard
