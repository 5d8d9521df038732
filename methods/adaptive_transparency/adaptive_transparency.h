// Adaptive transparency: every pixel keeps its visibility, the transmittance as a function of depth, in at most k
// nodes. A first pass over the fragments, in any order, builds the function. If that makes k + 1 nodes, the node is
// removed whose removal changes the area under the function least. A second pass weights each fragment by the
// visibility at its depth and adds it.
//
// With at most k fragments in a pixel, the picture is that of the exact order. With more, a removed node lowers the
// visibility and never raises it: no colour is brighter than in the exact order. Total alpha is always exact, and so is
// the visibility of the nearest fragment. Fragments with an alpha below 1e-5 are left out. The function depends on the
// order in which fragments come, which is that of the puffs in memory, so the picture is the same each time.
//
// The paper builds the function under ordered access to the pixel, which OpenGL 4.5 lacks (fragment interlock). Here, a
// compute shader works in tiles of 8 × 8 pixels: an invocation goes through the puffs of its tile twice.
//
// Units: metres. Colours: linear RGB, premultiplied.
// Source: SalviEtAl2011. Departs: tiles of a compute shader; nodes in single precision, 64 bits each, that stay in the
// invocation between the passes. The rule of removal is that of the authors' published shaders.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/draw/tile_pass.h"

namespace dustbench::adaptive_transparency {

enum class Puff {
    surface,  ///< as published: a surface at its centre's depth, with the alpha of the whole puff along the ray
    volume,   ///< cut by eye and scene, at the point on the ray nearest to its centre
};
inline constexpr Choices<Puff> puffKinds{{"surface", Puff::surface}, {"volume", Puff::volume}};

class AdaptiveTransparency final : public Method {
 public:
    AdaptiveTransparency(Puff puff, double reachDeviations, int nodes)
        : puff_(puff), reach_(reachDeviations), nodes_(nodes) {}

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
    int nodes_;
    std::optional<draw::PuffQuads> quads_;  ///< the puffs on the GPU
    std::optional<draw::TilePass> pass_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::adaptive_transparency
