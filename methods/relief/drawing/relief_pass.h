// Draws reliefs: each one and its depth, by ray casting or as a mesh with a vertex per texel; the car's shadow on them;
// and the picture that reliefs and dust are drawn into.
//
// Units: m; colours: linear RGB. Owns: depths, pyramid, colours and marks, on the GPU; the shadow map and the car's
// meshes; the picture. Threads: the OpenGL thread.
// Source: Policarpo2005 (linear and binary search); Oliveira2005 (curved panels); the safe march is exact within each
// bilinear patch, in a curved relief along the chords of the ray.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/kit/draw/shadow_map.h"
#include "methods/kit/draw/solid_mesh.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/relief/surface/depth_map.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

/// A shadow map of the car's body and wheels as seen from the sun.
class CarShadow {
 public:
    /// `scene` must have a vehicle and must outlive this.
    CarShadow(gpu::Device& device, const scene::Scene& scene);

    /// Draws the shadow map for the current moment.
    void draw(const scene::SceneState& state);

    void bind(std::uint32_t unit) const { map_.depth().bind(unit); }
    /// From a panel's frame to the map's texture coordinates and depth.
    [[nodiscard]] glm::mat4 fromPanel(const glm::dmat4& panelToWorld) const;
    [[nodiscard]] std::size_t gpuBytes() const { return map_.depth().bytes(); }

 private:
    const scene::VehicleModel& model_;
    draw::SolidMesh body_, wheel_;
    draw::ShadowMap map_;
    gpu::Program caster_;
};

/// The triangles of a relief as a mesh of vertex indices; relief_mesh.vert computes the positions.
///
/// Vertices: (columns + 2) × (rows + 2) of the surface, row by row, the outer ones at the rim; then the same number at
/// the bottom. Triangles: two per patch, then lower, upper, left and right rim, then the back: two if it is flat.
class ReliefMesh {
 public:
    ReliefMesh(gpu::Device& device, int columns, int rows, bool curved);

    [[nodiscard]] const gpu::VertexArray& vertices() const { return vertices_; }
    [[nodiscard]] int indexCount() const { return indexCount_; }
    /// Number of triangles of the surface, of a horizontal rim and of a vertical rim.
    [[nodiscard]] glm::ivec3 triangles() const { return triangles_; }
    [[nodiscard]] std::size_t bytes() const { return indices_.bytes(); }

 private:
    gpu::Buffer indices_;
    gpu::VertexArray vertices_;
    int indexCount_ = 0;
    glm::ivec3 triangles_{0};
};

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

/// Draws one relief.
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

/// A picture of the reliefs and the dust in front of them. Its depth is the scene's, with the reliefs drawn into it.
class SceneWithReliefs {
 public:
    SceneWithReliefs(gpu::Device& device, int width, int height);

    /// Clears the colour, copies the scene's depth and binds both for opaque drawing.
    void begin(const gpu::Texture& sceneDepth);
    /// The target for translucent drawing over everything drawn since `begin`.
    [[nodiscard]] const gpu::Layer& layer() const { return layer_; }
    /// Replaces the colour of `result`, which has the same size.
    void copyTo(gpu::Layer& result);

    [[nodiscard]] int width() const { return depth_.width(); }
    [[nodiscard]] int height() const { return depth_.height(); }
    [[nodiscard]] std::size_t gpuBytes() const { return depth_.bytes() + layer_.colour().bytes(); }

 private:
    gpu::Texture depth_;
    gpu::Layer layer_;
    gpu::Framebuffer opaque_;
    gpu::Program copyDepth_, copyColour_;
    gpu::VertexArray noVertices_;
};

}  // namespace dustbench::relief
