#include "methods/kit/raycast/raycast_parameters.h"

#include "methods/contract/errors.h"

namespace dustbench::raycast {

void declareRaycast(ParameterSet& parameters) {
    parameters
        .choice("backend", Backend::automatic, backends, "who casts the rays; auto: the CPU where OpenGL is software")
        .choice(
            "renderer", Renderer::raycast, renderers,
            "a march along each pixel's ray; planes across the view; a Gaussian for each cell; or an opaque surface "
            "of one density")
        .real("iso_density", 0.5, 1e-6, 1e6, "", "of renderer=isosurface")
        .choice("filter", Filter::linear, filters,
                "how cells are interpolated: not at all, each cell one value; between eight of them; or by a B-spline "
                "of 64")
        .real("step_cells", 0.5, 0.01, 8, "cells", "length of a ray's steps")
        .boolean("jitter", true, "shift each pixel's steps by a share of one: noise instead of bands")
        .real("stop_alpha", 0.99, 0, 1, "", "a ray ends where more than this is covered; 1: never")
        .boolean("skip_empty", true, "leave out blocks of cells without density")
        .integer(
            "shadow_cells", -1, -1, 16, "cells",
            "the sun's light falls off within the cloud, found in blocks of so many cells; 0: not; -1: as the file "
            "says");
}

RaycastSettings raycastSettings(const ParameterValues& values, int shadowCells) {
    RaycastSettings settings;
    settings.backend = values.choice("backend", backends);
    settings.renderer = values.choice("renderer", renderers);
    settings.isoDensity = values.real("iso_density");
    settings.filter = values.choice("filter", filters);
    settings.stepCells = values.real("step_cells");
    settings.jitter = values.boolean("jitter");
    settings.stopAlpha = values.real("stop_alpha");
    settings.skipEmpty = values.boolean("skip_empty");
    const auto shadow = static_cast<int>(values.integer("shadow_cells"));
    settings.shadowCells = shadow >= 0 ? shadow : shadowCells;
    return settings;
}

void lightDust(RaycastSettings& settings, const scene::Scene& scene) {
    constexpr int blockCells = 2;  // where the file has no shadows
    if (settings.renderer == Renderer::splat)
        throw InputError("parameter renderer: got splat with light=sun, allowed: raycast, slices, isosurface");
    if (settings.shadowCells == 0) settings.shadowCells = blockCells;
    settings.asymmetry = scene.dustAsymmetry;
}

}  // namespace dustbench::raycast
