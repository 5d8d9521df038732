// One relief drawn by itself, without sky, ground or dust: for experiments and benchmarks.
//
// Units: m. Owns: surface, picture and targets. Threads: the OpenGL thread.
#pragma once

#include <vector>

#include "methods/contract/view.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/pictures/image.h"
#include "methods/relief/drawing/relief_pass.h"
#include "methods/relief/drawing/scene_with_reliefs.h"
#include "methods/relief/surface/depth_pyramid.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

class ReliefStudio {
 public:
    /// `scene` and `panel` outlive this. `view` is in world space.
    ReliefStudio(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel, const ReliefStyle& style,
                 const scene::View& view);

    /// To be worn; drawn as it is at the next `draw`.
    [[nodiscard]] WornSurface& surface() { return surface_; }
    void draw();
    void draw(const scene::View& view);

    /// What was drawn last: linear, rows from the top, alpha 0 where the relief is not.
    [[nodiscard]] pictures::Image picture() const;
    /// The reversed depth beside it, rows from the bottom; 0 where the relief is not.
    [[nodiscard]] std::vector<float> depths() const;

 private:
    const scene::Panel& panel_;
    scene::View view_;
    MemoryLedger ledger_;
    WornSurface surface_;
    DepthPyramid pyramid_;
    ReliefPass pass_;
    gpu::Texture nothing_;
    SceneWithReliefs target_;
};

/// A view of a panel's middle that fills the picture's width, `degrees` off the face's normal towards +x.
[[nodiscard]] scene::View viewOf(const scene::Panel& panel, double degrees, int width, int height);

}  // namespace dustbench::relief
