// Draws one relief by ray casting, with its depth, so that other things meet it.
//
// Units: m; colours: linear RGB. Owns: depths, pyramid, colours and marks, on the GPU. Threads: the OpenGL thread.
// Source: Policarpo2005 (linear and binary search); the safe march is exact within each bilinear patch.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/gpu/vertex_array.h"
#include "methods/relief/surface/depth_pyramid.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

enum class March {
    paper,  ///< linear, then binary steps: may miss thin features
    safe,   ///< over blocks that the ray cannot hit, then patch by patch: misses nothing
};
inline constexpr Choices<March> marches{{"paper", March::paper}, {"safe", March::safe}};

struct ReliefStyle {
    March march = March::safe;
    int linearSteps = 15, binarySteps = 5;  ///< of March::paper
    bool shadow = true;                     ///< the relief shades itself
    bool whiteHits = false;                 ///< the paper's mark of a hit
    /// Removed and deposited material of this share of the depth is shown at full strength.
    float visibleShare = 0.05f;
};

class ReliefPass {
 public:
    ReliefPass(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel, const DepthPyramid& pyramid,
               const ReliefStyle& style);

    /// Copies the surface's depths and marks to the GPU. `changed`: the texels that differ from the last call.
    void upload(const WornSurface& surface, const DepthPyramid& pyramid, const TexelRectangle& changed);
    /// Draws into the bound target, with depth test and depth writes.
    void draw(const scene::View& view, const glm::dmat4& panelToWorld);

    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    void setLight(const glm::dmat4& panelToWorld);

    const scene::Scene& scene_;
    const scene::Panel& panel_;
    ReliefStyle style_;
    gpu::Program program_;
    gpu::VertexArray noVertices_;
    gpu::Buffer depths_, blocks_, levels_;
    gpu::Texture colours_, marks_;
    std::vector<float> depthValues_;
    std::vector<std::uint8_t> markValues_;
    glm::vec3 plateColour_{0.5f};
};

}  // namespace dustbench::relief
