// The solids of a scene and the plates of its panels at one moment, with the ground areas that their shadows can
// reach.
//
// Units: metres. Frame: world. Owns: their meshes on the GPU.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/solid.h"
#include "methods/contract/terrain.h"
#include "methods/kit/draw/ground_lattice.h"
#include "methods/kit/draw/solid_mesh.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::draw {

struct PlacedSolid {
    std::shared_ptr<SolidMesh> mesh;  ///< shared by all solids of the same shape
    bool castsOnly = false;           ///< another pass draws it
    glm::mat4 toWorld{1};
    glm::dvec3 centre{0};
    double radiusMetres = 0;
    std::vector<GroundRectangle> footprints{};              ///< the ground that its shadow can reach
    std::optional<std::size_t> moving{};                    ///< index in the scene, if it moves
    std::shared_ptr<const scene::DeformedMesh> deformed{};  ///< current shape, if it deforms

    [[nodiscard]] bool touches(const glm::dvec3& place, double reachMetres) const {
        return glm::distance(place, centre) - radiusMetres < reachMetres;
    }
};

class PlacedSolids {
 public:
    /// `scene` must outlive it. Throws std::invalid_argument if a solid lacks its pose.
    PlacedSolids(const scene::Scene& scene, gpu::Device& device);

    /// False if nothing has moved since the last moment.
    bool moveTo(const scene::SceneState& state);

    [[nodiscard]] const std::vector<PlacedSolid>& all() const { return all_; }
    /// Of all solids and plates; the rectangles do not overlap.
    [[nodiscard]] const std::vector<GroundRectangle>& footprints() const { return footprints_; }

 private:
    void add(const scene::Mesh& shape, const glm::mat4& pose, PlacedSolid solid);
    void place(PlacedSolid& solid, const scene::Mesh& shape, const glm::mat4& pose);
    void joinFootprints();

    const scene::Scene& scene_;
    std::vector<PlacedSolid> all_;
    std::vector<GroundRectangle> footprints_;
};

// --- The areas of the ground that an object's shadow can reach

/// Bounds, seen from above, of the box `minimum`..`maximum` (transformed by `toWorld`) and its shadow, enlarged by
/// `marginMetres`. A sun below 6° is treated as if at 6°.
[[nodiscard]] GroundRectangle shadowFootprint(const glm::vec3& minimum, const glm::vec3& maximum,
                                              const glm::dmat4& toWorld, const glm::vec3& toSun,
                                              const scene::Terrain& terrain, double marginMetres);

/// The same for a mesh that may consist of many separate objects (a row of posts): one rectangle per group of
/// neighbouring objects. The rectangles do not overlap.
[[nodiscard]] std::vector<GroundRectangle> shadowFootprints(const scene::Mesh& mesh, const glm::dmat4& toWorld,
                                                            const glm::vec3& toSun, const scene::Terrain& terrain,
                                                            double marginMetres);

/// Merges overlapping rectangles until none overlap, so that no ground is drawn twice.
void joinOverlapping(std::vector<GroundRectangle>& rectangles);

}  // namespace dustbench::draw
