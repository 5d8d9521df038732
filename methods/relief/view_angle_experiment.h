// Measures the pixels that a march over a relief misses, by viewing angle and number of steps.
//
// The wall and the sign of the scene relief_wall are drawn from 0°, 45°, 70°, 80° and 86° off their normal. Each pixel
// is compared with the exact first point of its ray (surface_hit.h). A pixel is missed if the picture has nothing
// there, or a point whose distance differs by more than the size of three texels, that is, a different part of the
// relief.
//
// Findings, over both panels: `missed_STEPS_ANGLE`, the share of the pixels missed by STEPS linear and 5 binary steps
// (15 is the default of `march=paper`), and `missed_safe_ANGLE`, `missed_mesh_ANGLE`. `missed_bump_ANGLE`: by bump
// mapping, which shows the texel where the ray meets the face, and misses where that is more than three texels from the
// exact point. `A_over_B` compares two of bump mapping, the paper's march (`relief`) and the mesh, which is
// displacement by geometry: the increase of the share that B misses from 0° to 70°, minus the same for A.
//
// Threads: the OpenGL thread. Source: Policarpo2005; Bergeron, 3.5.
#pragma once

#include "methods/contract/experiment.h"
#include "methods/relief/drawing/relief_pass.h"

namespace dustbench::relief::view_angle {

struct Seen {
    std::int64_t pixels = 0;      ///< pixels whose exact ray meets the relief
    std::int64_t bumpMissed = 0;  ///< pixels of these missed by bump mapping
    std::int64_t missed = 0;

    [[nodiscard]] double share() const { return ofPixels(missed); }
    [[nodiscard]] double bumpShare() const { return ofPixels(bumpMissed); }
    [[nodiscard]] double ofPixels(std::int64_t some) const {
        return pixels > 0 ? static_cast<double>(some) / static_cast<double>(pixels) : 0;
    }
};

[[nodiscard]] Seen seenAt(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel,
                          const ReliefStyle& style, double degrees);

[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::relief::view_angle
