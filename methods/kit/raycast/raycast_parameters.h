// The parameters of methods that show a grid: who casts the rays, by which technique, how finely.
#pragma once

#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"
#include "methods/kit/raycast/raycast_settings.h"

namespace dustbench::raycast {

/// Declares `backend`, `renderer`, `iso_density`, `filter`, `step_cells`, `jitter`, `stop_alpha`, `skip_empty` and
/// `shadow_cells`.
DUSTBENCH_API void declareRaycast(ParameterSet& parameters);

/// `shadowCells`: where the parameter says −1.
[[nodiscard]] DUSTBENCH_API RaycastSettings raycastSettings(const ParameterValues& values, int shadowCells);

/// Settings for dust that the scene's lights light (scene::Lights::onDust): it shadows itself. Throws InputError for a
/// renderer that has no ray of which the phase function could be taken.
DUSTBENCH_API void lightDust(RaycastSettings& settings, const scene::Scene& scene);

}  // namespace dustbench::raycast
