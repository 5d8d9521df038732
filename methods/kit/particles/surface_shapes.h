// The surfaces that a part can name: half-space, sphere, disc, mesh, or the contents of the scene.
//
// Units: m. Frame: world. Source: Thesis, 6.1.2 to 6.1.4.
#pragma once

#include <memory>

#include "methods/contract/parameters.h"
#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles {

enum class SurfaceShape { halfSpace, sphere, disc, mesh, scene };
inline constexpr Choices<SurfaceShape> surfaceShapes{{"half_space", SurfaceShape::halfSpace},
                                                     {"sphere", SurfaceShape::sphere},
                                                     {"disc", SurfaceShape::disc},
                                                     {"mesh", SurfaceShape::mesh},
                                                     {"scene", SurfaceShape::scene}};

/// The parameters of the shape, for parts that use the thesis's own test.
struct SurfaceNumbers {
    SurfaceShape shape;
    glm::vec3 place;
    glm::vec3 normal;  ///< unit
    float radiusMetres;
};

/// Declares `shape`, `place`, `normal`, `radius_metres`, those of a mesh, of a scene and of the drawing.
void declareSurface(ParameterSet& set);
/// Throws InputError for a normal of zero length.
[[nodiscard]] SurfaceNumbers surfaceNumbers(const ParameterValues& values);
/// What the surface looks like, if it is to be drawn.
[[nodiscard]] std::optional<Mark> markOfSurface(const ParameterValues& values);
/// A ball, hit from outside only.
[[nodiscard]] std::unique_ptr<Surface> makeBall(const glm::vec3& centre, float radiusMetres);
/// Makes the surface. A half-space or a sphere is hit from outside only; particles inside may leave. A disc or a mesh
/// is hit from both sides. Throws InputError if the mesh cannot be used.
[[nodiscard]] std::unique_ptr<Surface> makeSurface(const ParameterValues& values);

}  // namespace dustbench::particles
