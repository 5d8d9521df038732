// The surroundings of everything that a shape may collide with: the scene's solids and its vehicle, in separate parts.
//
// Parts that move are placed for every step; a part that deforms gets new cells when the shape comes close to it.
//
// Units: m, s. Frame: world; that of a part's cells is the solid's own. Owns: the parts' cells, one byte each. Threads:
// `moveTo` and `refresh` one caller at a time; other members are safe from any.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/contract/solid.h"
#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

/// Splits a mesh into separate objects: a scene stores all copies of a stone or a post as one mesh. Triangles that
/// share a corner position belong to one part; so do parts whose bounding boxes overlap, like the boards of a crate.
/// The parts have no normals and are ordered by their first triangle.
[[nodiscard]] std::vector<scene::Mesh> partsOf(const scene::Mesh& mesh);

/// A grid of flags around a mesh: one look-up shows whether a point is in or near the solid.
///
/// The flag of a cell is set if the solid, including its interior, comes within `reach` of the cell's centre. The test
/// is conservative: some other cells are flagged too, but none is missed. A voxel whose centre lies in a cell without
/// flag is therefore clear of the solid if `reach` is at least half the voxel's diagonal plus half the cell's.
class Nearness {
 public:
    /// Uses cells of `cellMetres`, or larger ones so that at most 128 fit along the mesh's longest side. `reachMetres`:
    /// the reach that callers need; half a cell's diagonal is added to it. A mesh that encloses nothing is represented
    /// by its surface only.
    Nearness(const scene::Mesh& mesh, float cellMetres, float reachMetres);

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }
    /// `place` is in cells from the lattice's minimum corner.
    [[nodiscard]] bool at(const glm::vec3& place) const {
        // NaN and points outside the lattice are not near. Test before the cast, which rounds negative values towards
        // 0.
        if (!(place.x >= 0 && place.y >= 0 && place.z >= 0)) return false;
        const glm::vec3 counts(lattice_.counts);
        if (!(place.x < counts.x && place.y < counts.y && place.z < counts.z)) return false;
        return near_[lattice_.index(glm::ivec3(place))] != 0;
    }
    [[nodiscard]] std::size_t bytes() const { return near_.capacity(); }

 private:
    Lattice lattice_;
    std::vector<std::uint8_t> near_;
};

struct AxisBox {
    glm::vec3 minimum{INFINITY}, maximum{-INFINITY};

    void take(const glm::vec3& point) {
        minimum = glm::min(minimum, point);
        maximum = glm::max(maximum, point);
    }
    [[nodiscard]] bool meets(const AxisBox& other) const {
        return glm::all(glm::lessThanEqual(minimum, other.maximum)) &&
               glm::all(glm::lessThanEqual(other.minimum, maximum));
    }
    /// Calls `visit` with each corner.
    template <typename Visit>
    void forEachCorner(const Visit& visit) const {
        for (int corner = 0; corner < 8; ++corner)
            visit(glm::vec3(corner & 1 ? maximum.x : minimum.x, corner & 2 ? maximum.y : minimum.y,
                            corner & 4 ? maximum.z : minimum.z));
    }
};

/// Which objects a shape collides with.
struct Collidable {
    bool solids = true, vehicle = false;

    bool operator==(const Collidable&) const = default;
};
inline constexpr Choices<Collidable> collidables{
    {"none", {false, false}}, {"solids", {true, false}}, {"vehicle", {false, true}}, {"everything", {true, true}}};

class SolidPlaces {
 public:
    /// `voxelMetres`: the largest edge that the shape's voxels will have in the world.
    SolidPlaces(const scene::Scene& scene, float voxelMetres, const Collidable& with);

    /// Moves the parts to their poses at the end of a step.
    void moveTo(const scene::Scene& scene, const scene::SceneState& state, double stepSeconds);
    /// Makes new cells for the deforming parts whose boxes meet this one.
    void refresh(const AxisBox& box);

    [[nodiscard]] bool empty() const { return places_.empty(); }
    /// Numbers of the parts that come within reach of the box at the step's end, or, with `anyTime`, during the step.
    [[nodiscard]] std::vector<std::uint32_t> meeting(const AxisBox& box, bool anyTime) const;
    /// Whether a point is within reach of any of the parts at the step's end. Parts without cells are not near.
    [[nodiscard]] bool nearAny(std::span<const std::uint32_t> places, const glm::vec3& point) const;
    /// Whether a path of this length that ends at `point` may cross the surface of any of the parts.
    [[nodiscard]] bool mayHit(std::span<const std::uint32_t> places, const glm::vec3& point, float lengthMetres) const;
    [[nodiscard]] std::size_t bytes() const;

 private:
    /// What a part belongs to.
    struct Carrier {
        enum class Kind { still, solid, body, wheel } kind;
        std::size_t number;
    };
    struct Place {
        Carrier carrier;
        std::optional<Nearness> nearness{};  ///< empty: of a deforming part to which the shape is not close
        std::shared_ptr<const scene::DeformedMesh> shape{};  ///< of a deforming part, at the step's end
        AxisBox local{};                                     ///< of all points within reach, in the object's frame
        std::optional<glm::mat4> toWorld{};                  ///< at the step's end; empty before the first step
        glm::mat3 toCells{1};                                ///< world → cells: toCells·p + offset
        glm::vec3 offset{0};
        AxisBox box{}, swept{};  ///< of `local` in the world, at the step's end and during the step
        float movedMetres = 0;   ///< bound on the distance that any of its points moves during the step

        void moveTo(const scene::SolidPose& pose, double stepSeconds);
        void deformTo(const std::shared_ptr<const scene::DeformedMesh>& next, float reachMetres);
        void placeCells();
    };

    /// Adds the parts of a mesh.
    void add(const scene::Mesh& mesh, float scale, const Carrier& carrier);
    [[nodiscard]] Nearness cellsAround(const scene::Mesh& mesh, float scale) const;

    float cellMetres_, reachMetres_;
    std::vector<Place> places_;
};

}  // namespace dustbench::voxel_shape
