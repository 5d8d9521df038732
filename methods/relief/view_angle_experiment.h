// What a march over a relief misses, over the angle of view and its number of steps.
//
// The wall and the sign of the scene relief_wall are drawn from 0°, 45°, 70°, 80° and 86° off their normal. Each pixel
// is held against the exact first point of its ray (surface_hit.h). A pixel is missed if the picture has nothing there,
// or a point whose distance differs by more than the size of three texels: then something else is shown.
//
// Findings, over both panels: `missed_STEPS_ANGLE`, the share of the pixels missed by STEPS linear and 5 binary steps
// (15 is the paper's), and `missed_safe_ANGLE`, `missed_mesh_ANGLE`. `missed_bump_ANGLE`: by bump mapping, which shows
// the texel of the face that the ray meets, and misses where it is more than three texels beside the exact point.
// Two ways against each other, `A_over_B`: how much more of the pixels B misses at 70° than at 0°, less the same of A;
// bump mapping, the paper's march (`relief`) and the mesh, which is displacement by geometry.
//
// Threads: the OpenGL thread. Source: Policarpo2005; Bergeron, 3.5.
#pragma once

#include "methods/contract/experiment.h"
#include "methods/relief/drawing/relief_pass.h"

namespace dustbench::relief::view_angle {

struct Seen {
    std::int64_t pixels = 0;      ///< in which the exact ray meets the relief
    std::int64_t bumpMissed = 0;  ///< of them, by bump mapping
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
