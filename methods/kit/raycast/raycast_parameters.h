// The parameters of methods that draw a grid: processor, technique and resolution.
#pragma once

#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"
#include "methods/kit/raycast/raycast_settings.h"

namespace dustbench::raycast {

/// Declares `backend`, `renderer`, `iso_density`, `filter`, `step_cells`, `jitter`, `stop_alpha`, `skip_empty` and
/// `shadow_cells`.
DUSTBENCH_API void declareRaycast(ParameterSet& parameters);

/// `shadowCells`: used if the parameter is −1.
[[nodiscard]] DUSTBENCH_API RaycastSettings raycastSettings(const ParameterValues& values, int shadowCells);

/// Settings for dust lit by the scene's lights (scene::Lights::onDust): it shadows itself. Throws InputError for a
/// renderer without rays, to which the phase function cannot be applied.
DUSTBENCH_API void lightDust(RaycastSettings& settings, const scene::Scene& scene);

}  // namespace dustbench::raycast
