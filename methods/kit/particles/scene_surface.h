// The contents of a scene as one surface: its ground, its solids, and the moving vehicle.
//
// Ground and wheels are hit from outside; the triangles of solids and of the vehicle's body from both sides. The ground
// is bilinear, as in scene::Terrain; particles below it may rise. Solids that move or deform do so during the step,
// like the vehicle. A wheel is the cylinder of its outline, without spokes, and its surface moves with its spin. Panels
// are ignored.
//
// Units: m, m/s, s. Frame: world. Owns: the triangles' trees. Threads: `meet` and `touchAt` are safe from any.
#pragma once

#include <optional>
#include <set>

#include "methods/contract/terrain.h"
#include "methods/kit/meshes/triangle_tree.h"
#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/moving_solids.h"

namespace dustbench::particles {

/// Writes the share at which each path first hits the ground, or Surface::none.
void meetGround(const Ways& ways, const scene::Terrain& terrain, float* share);

struct SceneParts {
    bool ground = true, solids = true, vehicle = true;
};

class DUSTBENCH_API SceneSurface final : public Surface {
 public:
    explicit SceneSurface(const SceneParts& parts) : parts_(parts) {}
    ~SceneSurface() override;

    /// Throws InputError if there are too many triangles for Embree.
    void begin(const Step& step) override;
    void meet(const Ways& ways, float* share) const override;
    [[nodiscard]] Touch touchAt(const Meeting& meeting) const override;
    [[nodiscard]] float extentMetres() const override { return extentMetres_; }
    [[nodiscard]] std::size_t bytes() const override;

 private:
    struct Box {
        glm::vec3 minimum{INFINITY}, maximum{-INFINITY};
        void take(const glm::vec3& point);
        void take(const Box& other);
        [[nodiscard]] bool meets(const glm::vec3& from, const glm::vec3& to) const;
    };
    /// A path relative to a moving object at the step's end.
    struct LocalWay {
        glm::vec3 from, to;
        glm::vec3 deforming{0};  ///< velocity of the surface by its deformation, in the frame

        [[nodiscard]] glm::vec3 at(float share) const { return from + share * (to - from); }
    };
    /// The vehicle's body, a wheel, or a moving solid.
    struct Carried {
        std::optional<std::size_t> solid{};  ///< its index
        bool stands = false;                 ///< a movable solid at rest in this step: part of `solids_`
        CarriedFrame frame{};
        Box local{}, swept{};    ///< `swept`: over the whole step
        glm::vec3 spin{0};       ///< rad/s about the origin, in the non-spinning frame
        float radiusMetres = 0;  ///< of a wheel; 0: not a wheel
        float halfWidthMetres = 0;
        meshes::TriangleTree rigid{};
        std::optional<Deformation> deformation{};

        void moveTo(const glm::dmat4& toWorld, const glm::dvec3& velocity, double stepSeconds);
        [[nodiscard]] const meshes::TriangleTree& tree() const {
            return deformation ? deformation->treeAtEnd() : rigid;
        }
        [[nodiscard]] LocalWay toLocal(const Meeting& way) const;
    };
    struct Found {
        float share = none;
        const Carried* carried = nullptr;  ///< null: ground or a still solid
        glm::vec3 normal{0, 1, 0};         ///< in the frame of the object that was hit
    };

    void build(const scene::Scene& scene);
    void buildStill(const scene::SceneState& state);
    void addMovingSolids(const scene::Scene& scene);
    void addVehicle(const scene::VehicleModel& vehicle);
    void moveCarried(const Step& step);
    void moveSolid(Carried& carried, const Step& step);
    [[nodiscard]] Found find(const Meeting& way, float groundShare) const;
    [[nodiscard]] Found findOn(const Carried& carried, const Meeting& way) const;

    SceneParts parts_;
    const scene::Scene* scene_ = nullptr;            ///< scene of the current trees
    meshes::TriangleTree solids_;                    ///< fixed ones, and movable ones at rest in this step
    std::optional<std::set<std::size_t>> standing_;  ///< the movable ones in `solids_`
    Box solidsBox_, carriedBox_;
    std::vector<Carried> carried_;
    float extentMetres_ = 0;
};

}  // namespace dustbench::particles
