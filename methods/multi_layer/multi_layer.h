// Multi-layer alpha blending: every pixel keeps k layers, sorted by depth. Each fragment is inserted by its depth. If
// that makes k + 1 layers, the two farthest are merged. With at most k fragments the order is exact. Total alpha always
// is, but for fragments with an alpha below 1e-5, which are left out.
//
// The paper inserts fragments in a pixel shader under a fragment interlock, which OpenGL 4.5 lacks. Here, a compute
// shader works in tiles of 8 × 8 pixels: an invocation goes through the puffs of its tile in their order in memory,
// which is the draw order of the paper, and keeps the layers of its pixel. The picture hence is the same each time.
//
// Units: metres. Colours: linear RGB, premultiplied.
// Source: SalviVaidyanathan2014. Departs: tiles of a compute shader instead of pixel synchronisation; layers in
// single precision, 160 bits each.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/draw/tile_pass.h"

namespace dustbench::multi_layer {

enum class Puff {
    surface,  ///< a surface at its centre's depth, with the alpha of the whole puff along the ray
    volume,   ///< cut by eye and scene, at the point on the ray nearest to its centre
};
inline constexpr Choices<Puff> puffKinds{{"surface", Puff::surface}, {"volume", Puff::volume}};

class MultiLayer final : public Method {
 public:
    MultiLayer(Puff puff, double reachDeviations, int layers) : puff_(puff), reach_(reachDeviations), layers_(layers) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] bool reportsAtEnd() const override { return true; }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    Puff puff_;
    double reach_;
    int layers_;
    std::optional<draw::PuffQuads> quads_;  ///< the puffs on the GPU
    std::optional<draw::TilePass> pass_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::multi_layer
