#include "methods/kit/raycast/raycast_settings.h"

#include <cmath>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::raycast {
namespace {

void checkRange(const char* name, double got, double minimum, double maximum) {
    if (!(got >= minimum && got <= maximum))
        throw InputError(std::string("ray cast: ") + name + ": got " + std::to_string(got) +
                         ", allowed: " + std::to_string(minimum) + ".." + std::to_string(maximum));
}

}  // namespace

void check(const RaycastSettings& settings) {
    if (settings.backend == Backend::cpu && settings.renderer != Renderer::raycast)
        throw InputError("ray cast: got backend cpu, allowed for renderers other than raycast: auto, gl");
    checkRange("step in cells", settings.stepCells, 0.01, 8);
    checkRange("stop alpha", settings.stopAlpha, 0, 1);
    checkRange("shadow cells", settings.shadowCells, 0, 64);
    checkRange("extinction per metre", settings.extinctionPerMetre, 0, 1e6);
    checkRange("density of the isosurface", settings.isoDensity, 1e-6, 1e6);
    for (int channel = 0; channel < 3; ++channel)
        checkRange("smoke colour", static_cast<double>(settings.smokeColour[channel]), 0, 1);
}

float opaqueDepth(const RaycastSettings& settings) {
    return static_cast<float>(-std::log1p(-settings.stopAlpha));
}

void declareRaycast(ParameterSet& parameters) {
    parameters
        .choice("backend", Backend::automatic, backends, "where rays are cast; auto: on the CPU if OpenGL is software")
        .choice("renderer", Renderer::raycast, renderers,
                "marching along each pixel's ray; planes across the view; a Gaussian per cell; or an opaque surface at "
                "one density")
        .real("iso_density", 0.5, 1e-6, 1e6, "", "density of renderer=isosurface")
        .choice("filter", Filter::linear, filters,
                "interpolation of cells: none, one value per cell; linear between eight cells; or a cubic B-spline "
                "over 64")
        .real("step_cells", 0.5, 0.01, 8, "cells", "step length of a ray")
        .boolean("jitter", true, "shift each pixel's steps by a fraction of a step: noise instead of bands")
        .real("stop_alpha", 0.99, 0, 1, "", "alpha at which a ray ends; 1: never")
        .boolean("skip_empty", true, "skip blocks of cells without density")
        .integer("shadow_cells", -1, -1, 16, "cells",
                 "edge of the blocks in which the cloud's own shadow is computed; 0: no shadow; -1: as in the file");
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
    constexpr int blockCells = 2;  // if the file has no shadows
    if (settings.renderer == Renderer::splat)
        throw InputError("parameter renderer: got splat with light=sun, allowed: raycast, slices, isosurface");
    if (settings.shadowCells == 0) settings.shadowCells = blockCells;
    settings.asymmetry = scene.dustAsymmetry;
}

}  // namespace dustbench::raycast
