// Draws one relief without sky, ground or dust, for experiments and benchmarks.
//
// Units: m. Owns: surface, picture and targets. Threads: the OpenGL thread.
#pragma once

#include <vector>

#include "methods/contract/view.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/pictures/image.h"
#include "methods/relief/drawing/relief_pass.h"
#include "methods/relief/surface/depth_map.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

class ReliefStudio {
 public:
    /// `scene` and `panel` must outlive this. `view` is in world space.
    ReliefStudio(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel, const ReliefStyle& style,
                 const scene::View& view);

    /// The surface to wear; `draw` shows its current state.
    [[nodiscard]] WornSurface& surface() { return surface_; }
    void draw();
    void draw(const scene::View& view);

    /// The picture drawn last: linear, rows from the top, alpha 0 outside the relief.
    [[nodiscard]] pictures::Image picture() const;
    /// The reversed depth of the picture drawn last, rows from the bottom; 0 outside the relief.
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

/// A view of a panel's centre, `degrees` off the face's normal towards +x; the panel fills the picture's width.
[[nodiscard]] scene::View viewOf(const scene::Panel& panel, double degrees, int width, int height);

}  // namespace dustbench::relief
