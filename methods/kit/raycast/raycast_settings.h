// Settings for drawing a grid, and the parameters that set them: processor, technique and resolution.
//
// Units: cells where stated, extinction per metre. Colours: linear RGB. Source: Senger2009, ch. 2 and 4.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/choices.h"
#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"
#include "methods/kit/raycast/transfer_function.h"

namespace dustbench::raycast {

enum class Backend {
    automatic,  ///< the CPU if OpenGL is a software implementation, else OpenGL
    cpu,
    gl,
};
inline constexpr Choices<Backend> backends{{"auto", Backend::automatic}, {"cpu", Backend::cpu}, {"gl", Backend::gl}};

enum class Renderer {
    raycast,     ///< ray marching for each pixel
    slices,      ///< blended planes perpendicular to the view; OpenGL only, as are all below
    splat,       ///< a Gaussian per cell
    isosurface,  ///< opaque, at one density value
};
inline constexpr Choices<Renderer> renderers{{"raycast", Renderer::raycast},
                                             {"slices", Renderer::slices},
                                             {"splat", Renderer::splat},
                                             {"isosurface", Renderer::isosurface}};

/// Interpolation between cell centres; constant beyond the outermost ones.
enum class Filter {
    nearest,  ///< none: each cell has one value, so that cells show as blocks
    linear,
    cubic,  ///< B-spline: smoother and never negative, but blurs
};
inline constexpr Choices<Filter> filters{
    {"nearest", Filter::nearest}, {"linear", Filter::linear}, {"cubic", Filter::cubic}};

struct RaycastSettings {
    Backend backend = Backend::automatic;
    Renderer renderer = Renderer::raycast;
    Filter filter = Filter::linear;
    double stepCells = 0.5;
    bool jitter = true;       ///< offsets each pixel's steps by a fixed fraction of a step: noise instead of banding
    double stopAlpha = 0.99;  ///< a ray ends when its alpha exceeds this; 1: never
    bool skipEmpty = true;    ///< skips bricks of cells without density
    int shadowCells = 0;      ///< block size in cells for self-shadowing of the sun's light; 0: no shadow
    /// For scene::phaseFactor, with self-shadowed sunlight drawn by rays or planes; 0: isotropic.
    float asymmetry = 0;
    double extinctionPerMetre = 1;               ///< at a density of 1
    double isoDensity = 0.5;                     ///< of the isosurface
    glm::vec3 smokeColour{0.64f, 0.54f, 0.42f};  ///< albedo
    TransferFunction fire;
};

/// Throws InputError for values out of range.
DUSTBENCH_API void check(const RaycastSettings& settings);

/// The optical depth at which a ray may end; infinite if it never may.
[[nodiscard]] DUSTBENCH_API float opaqueDepth(const RaycastSettings& settings);

/// Declares `backend`, `renderer`, `iso_density`, `filter`, `step_cells`, `jitter`, `stop_alpha`, `skip_empty` and
/// `shadow_cells`.
DUSTBENCH_API void declareRaycast(ParameterSet& parameters);

/// `shadowCells`: used if the parameter is −1.
[[nodiscard]] DUSTBENCH_API RaycastSettings raycastSettings(const ParameterValues& values, int shadowCells);

/// Settings for dust lit by the scene's lights (scene::Lights::onDust): it shadows itself. Throws InputError for a
/// renderer without rays, to which the phase function cannot be applied.
DUSTBENCH_API void lightDust(RaycastSettings& settings, const scene::Scene& scene);

}  // namespace dustbench::raycast
