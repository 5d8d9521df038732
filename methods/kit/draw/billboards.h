// Puffs as camera-facing quads, all in one instanced draw call.
//
// A puff of peak opacity α and radius r is drawn as 1 − exp(−τ·exp(−b²/2s²)), b being the distance of the pixel's ray
// from its centre, on a quad of half-side 1.5 r = 3s. Textured puffs take the Gaussian's place with the same mass.
//
// Units: m. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread's.
// Source: Carr2006, 3.1. Departs: opacity by Beer and Lambert's law instead of a picture's own.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/choices.h"
#include "methods/contract/view.h"
#include "methods/kit/draw/instance_batch.h"
#include "methods/kit/draw/puff_textures.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::draw {

enum class Facing {
    viewpoint,  ///< each quad perpendicular to the ray to its centre; b is exact
    viewplane,  ///< all quads parallel to the picture; b is measured in that plane, too long away from its middle
};
inline constexpr Choices<Facing> facings{{"viewpoint", Facing::viewpoint}, {"viewplane", Facing::viewplane}};

struct BillboardStyle {
    Facing facing = Facing::viewpoint;
    /// Each puff ends at the scene behind it, by the closed form, instead of being cut off by the depth test.
    bool soft = false;
    /// Light is added and nothing is covered, as by fire: C = αC_puff + C, in any order.
    bool additive = false;
};

class DUSTBENCH_API Billboards : public InstanceBatch {
 public:
    /// `pictures` (may be null: Gaussian puffs) must outlive this.
    Billboards(gpu::Device& device, const BillboardStyle& style, const PuffTextures* pictures = nullptr);

    /// x y z radius opacity [picture] [red green blue]
    [[nodiscard]] InstanceLayout layout(bool coloured) const {
        return {5u + (framed() ? 1u : 0u) + (coloured ? 3u : 0u), coloured};
    }
    /// Whether a billboard says which picture it shows: 0..frames()−1, with a share where they are cross-faded.
    [[nodiscard]] bool framed() const { return pictures_ != nullptr; }

    /// Draws what was mapped last, as often as wanted. `colourOfAll` is for billboards without colours of their own.
    void draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer);

 private:
    BillboardStyle style_;
    const PuffTextures* pictures_;
};

}  // namespace dustbench::draw
