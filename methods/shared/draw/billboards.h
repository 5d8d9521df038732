// Puffs as camera-facing quads, all in one instanced draw call.
//
// A puff of peak opacity α and radius r is drawn as 1 − exp(−τ·exp(−b²/2s²)), b being the distance of the pixel's ray
// from its centre, on a quad of half-side 1.5 r = 3s. Textured puffs take the Gaussian's place with the same mass.
//
// Units: m. Frame: world. Colours: linear RGB. Owns: the instances, on the GPU. Threads: the OpenGL thread's.
// Source: Carr2006, 3.1. Departs: opacity by Beer and Lambert's law instead of a picture's own.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "methods/shared/draw/puff_textures.h"
#include "methods/shared/gpu/buffer.h"
#include "methods/shared/gpu/layer.h"
#include "methods/shared/gpu/program.h"
#include "methods/shared/gpu/vertex_array.h"
#include "methods/shared/scene/view.h"

namespace dustbench::draw {

enum class Facing {
    viewpoint,  ///< each quad perpendicular to the ray to its centre; b is exact
    viewplane,  ///< all quads parallel to the picture; b is measured in that plane, too long away from its middle
};

struct BillboardStyle {
    Facing facing = Facing::viewpoint;
    /// Each puff ends at the scene behind it, by the closed form, instead of being cut off by the depth test.
    bool soft = false;
};

class Billboards {
 public:
    /// `pictures` (may be null: Gaussian puffs) must outlive this.
    Billboards(gpu::Device& device, const BillboardStyle& style, const PuffTextures* pictures = nullptr);

    /// Where the values of one billboard lie.
    struct Layout {
        std::size_t floats = 5;  ///< x y z radius opacity, then:
        bool framed = false;    ///< the picture, where there are pictures: 0..frames()−1, with a share if cross-faded
        bool coloured = false;  ///< red green blue, where not all have one colour
    };
    [[nodiscard]] Layout layout(bool coloured) const;

    /// GPU memory for `count` billboards in drawing order; write-only, to be filled and unmapped.
    [[nodiscard]] std::span<float> map(std::size_t count, const Layout& layout);
    void unmap();

    /// Draws what was mapped last, as often as wanted. `colourOfAll` is for billboards without colours of their own.
    void draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t gpuBytes() const { return instances_.bytes() + corners_.bytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    BillboardStyle style_;
    const PuffTextures* pictures_;
    gpu::Buffer instances_;
    gpu::Buffer corners_;
    gpu::VertexArray vertices_;
    std::optional<gpu::Program> oneColour_, ownColours_;  ///< made when first wanted
    Layout layout_;
    std::size_t count_ = 0;
};

}  // namespace dustbench::draw
