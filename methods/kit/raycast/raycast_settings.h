// How a grid is shown.
//
// Units: cells where it says so, extinction per metre. Colours: linear RGB. Source: Senger2009, ch. 2 and 4.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/choices.h"
#include "methods/kit/raycast/transfer_function.h"

namespace dustbench::raycast {

enum class Backend {
    automatic,  ///< the CPU where OpenGL is software, else OpenGL
    cpu,
    gl,
};
inline constexpr Choices<Backend> backends{{"auto", Backend::automatic}, {"cpu", Backend::cpu}, {"gl", Backend::gl}};

enum class Renderer {
    raycast,     ///< a march along each pixel's ray
    slices,      ///< planes across the view, blended; OpenGL only, as all that follow
    splat,       ///< a Gaussian for each cell
    isosurface,  ///< opaque, where the density has one value
};
inline constexpr Choices<Renderer> renderers{{"raycast", Renderer::raycast},
                                             {"slices", Renderer::slices},
                                             {"splat", Renderer::splat},
                                             {"isosurface", Renderer::isosurface}};

/// Between the middles of cells; beyond the outermost ones the values stay.
enum class Filter {
    linear,
    cubic,  ///< B-spline: smoother and never negative, but it blurs
};
inline constexpr Choices<Filter> filters{{"linear", Filter::linear}, {"cubic", Filter::cubic}};

struct RaycastSettings {
    Backend backend = Backend::automatic;
    Renderer renderer = Renderer::raycast;
    Filter filter = Filter::linear;
    double stepCells = 0.5;
    bool jitter = true;       ///< shifts each pixel's steps by a fixed share of one: noise instead of bands
    double stopAlpha = 0.99;  ///< a ray ends where more than this is covered; 1: never
    bool skipEmpty = true;    ///< leave out bricks of cells without density
    int shadowCells = 0;      ///< the sun's light falls off within the cloud, found in blocks of so many cells; 0: not
    double extinctionPerMetre = 1;               ///< of a density of 1
    double isoDensity = 0.5;                     ///< of the isosurface
    glm::vec3 smokeColour{0.64f, 0.54f, 0.42f};  ///< albedo
    TransferFunction fire;
};

/// Throws InputError for values out of range.
void check(const RaycastSettings& settings);

/// The optical depth at which a ray may end; infinite where it never may.
[[nodiscard]] float opaqueDepth(const RaycastSettings& settings);

}  // namespace dustbench::raycast
