// Draws puffs as camera-facing quads in one instanced draw call.
//
// A puff of peak opacity α and radius r is drawn with opacity 1 − exp(−τ·exp(−b²/2s²)), where b is the distance of the
// pixel's ray from its centre, on a quad of half-side 1.5 r = 3s. A texture replaces the Gaussian, with the same mass.
//
// Units: m. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread.
// Source: Carr2006, 3.1. Departs: opacity by the Beer–Lambert law instead of a picture's own.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/choices.h"
#include "methods/contract/view.h"
#include "methods/kit/draw/instance_batch.h"
#include "methods/kit/draw/puff_textures.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::draw {

enum class Facing {
    viewpoint,  ///< each quad is perpendicular to the ray to its centre; b is exact
    viewplane,  ///< all quads are parallel to the image; b is measured in that plane and too large away from the image
                ///< centre
};
inline constexpr Choices<Facing> facings{{"viewpoint", Facing::viewpoint}, {"viewplane", Facing::viewplane}};

struct BillboardStyle {
    Facing facing = Facing::viewpoint;
    /// Fades each puff out at the scene behind it, in closed form, instead of clipping it by the depth test.
    bool soft = false;
    /// Opacity as in 2006: the puff's own, multiplied by the picture's alpha; without pictures by a circle's, which
    /// falls smoothly from 1 at the centre to 0 at a distance of 1.5 r: 1 − 3u² + 2u³. Otherwise by the Beer–Lambert
    /// law.
    bool plainAlpha = false;
    /// Adds light without covering anything, like fire: C = αC_puff + C, in any order.
    bool additive = false;
    /// Each billboard has a displacement and is drawn at several points along it: copies of a moving puff.
    bool moving = false;
    /// Amplitude of the noise that each billboard has (puff_noise.h); 0: none.
    float noise = 0;
};

class DUSTBENCH_API Billboards : public InstanceBatch {
 public:
    /// `pictures` must outlive this; null selects Gaussian puffs.
    Billboards(gpu::Device& device, const BillboardStyle& style, const PuffTextures* pictures = nullptr);

    /// x y z radius opacity [picture] [displacement: 3] [NoisePlace: 4] [red green blue]
    [[nodiscard]] InstanceLayout layout(bool coloured) const {
        return {5u + (framed() ? 1u : 0u) + (style_.moving ? 3u : 0u) + (noisy() ? 4u : 0u) + (coloured ? 3u : 0u),
                coloured};
    }
    [[nodiscard]] bool noisy() const { return style_.noise > 0; }
    /// Whether each billboard names the picture it shows: 0..frames()−1, with a fraction for cross-fading.
    [[nodiscard]] bool framed() const { return pictures_ != nullptr; }

    /// Draws the instances mapped last; may be called repeatedly. `colourOfAll` applies to billboards without their own
    /// colours.
    void draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer) {
        drawCopy(view, colourOfAll, layer, {0, 1});
    }
    /// For moving billboards: the position and the weight of one copy.
    struct Copy {
        float back;   ///< fraction of the displacement by which each is moved back
        float share;  ///< share of the optical depth (additive: of the light)
    };
    void drawCopy(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer, const Copy& copy);

 private:
    BillboardStyle style_;
    const PuffTextures* pictures_;
};

}  // namespace dustbench::draw
