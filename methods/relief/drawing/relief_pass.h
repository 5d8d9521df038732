// Draws one relief and its depth, by ray casting or as a mesh with a vertex per texel.
//
// Units: m; colours: linear RGB. Owns: depths, pyramid, colours and marks, on the GPU. Threads: the OpenGL thread.
// Source: Policarpo2005 (linear and binary search); the safe march is exact within each bilinear patch.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/kit/draw/dust_shadow.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/gpu/vertex_array.h"
#include "methods/relief/drawing/car_shadow.h"
#include "methods/relief/drawing/relief_mesh.h"
#include "methods/relief/surface/depth_pyramid.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

enum class March {
    paper,  ///< linear, then binary steps: may miss thin features
    safe,   ///< skips blocks that the ray cannot hit, then goes patch by patch: misses nothing
    mesh,   ///< no march: two triangles per patch, by the rasteriser; shadows by `safe`
};
inline constexpr Choices<March> marches{{"paper", March::paper}, {"safe", March::safe}, {"mesh", March::mesh}};

struct ReliefStyle {
    March march = March::safe;
    int linearSteps = 15, binarySteps = 5;  ///< of March::paper
    bool shadow = true;                     ///< the relief shades itself
    bool carShadow = false;                 ///< the car casts its shadow on it
    bool dustShadow = false;                ///< the dust casts its shadow on it
    bool whiteHits = false;                 ///< the paper's mark of a hit
    /// Removed and deposited material of this share of the depth is shown at full strength.
    float visibleShare = 0.05f;
};

class ReliefPass {
 public:
    ReliefPass(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel, const DepthPyramid& pyramid,
               const ReliefStyle& style);

    /// Copies the surface's depths and marks to the GPU. `changed`: the texels that differ from the last call. Returns
    /// how many bytes it copied.
    std::size_t upload(const WornSurface& surface, const DepthPyramid& pyramid, const TexelRectangle& changed);
    /// Draws into the bound target, with depth test and depth writes. `shadow`: only for a style with `carShadow`;
    /// `dust`: only for one with `dustShadow`.
    void draw(const scene::View& view, const glm::dmat4& panelToWorld, const CarShadow* shadow = nullptr,
              const draw::DustShadow* dust = nullptr);

    /// The unlit colour of a texel as drawn: linear RGB.
    [[nodiscard]] glm::vec3 colourOf(const WornSurface& surface, std::size_t texel) const;
    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    [[nodiscard]] std::size_t uploadTexels(const WornSurface& surface, const TexelRectangle& changed);
    [[nodiscard]] std::size_t uploadBlocks(const DepthPyramid& pyramid, const TexelRectangle& changed);
    [[nodiscard]] bool marchesBlocks() const;
    void bindSurface();
    void setLight(const glm::dmat4& panelToWorld);

    const scene::Scene& scene_;
    const scene::Panel& panel_;
    ReliefStyle style_;
    gpu::Program program_;
    gpu::VertexArray noVertices_;
    gpu::Buffer depths_, blocks_, levels_;
    std::optional<ReliefMesh> mesh_;  ///< of March::mesh
    gpu::Texture colours_, marks_;
    std::vector<float> depthValues_;        ///< of all texels
    std::vector<std::uint8_t> markValues_;  ///< of the changed texels
    glm::vec3 plateColour_{0.5f};
};

}  // namespace dustbench::relief
