// What a scene holds as one surface: its ground, its solids, and the moving vehicle.
//
// Ground and wheels are met from outside; the triangles of solids and of the vehicle's body from both sides. Solids
// that move or deform do so during the step, as the vehicle does. A wheel is the cylinder of its outline, whatever its
// spokes, and turns: its surface moves with its spin. Panels are not met.
//
// Units: m, m/s, s. Frame: world. Owns: the triangles' trees. Threads: `meet` and `touchAt` are safe from any.
#pragma once

#include <optional>
#include <set>

#include "methods/kit/meshes/triangle_tree.h"
#include "methods/kit/particles/carried_frame.h"
#include "methods/kit/particles/deformation.h"
#include "methods/kit/particles/surface.h"

namespace dustbench::particles {

struct SceneParts {
    bool ground = true, solids = true, vehicle = true;
};

class SceneSurface final : public Surface {
 public:
    explicit SceneSurface(const SceneParts& parts) : parts_(parts) {}

    /// Throws InputError if the triangles are too many for Embree.
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
    /// A way as something that moves sees it at the step's end.
    struct LocalWay {
        glm::vec3 from, to;
        glm::vec3 deforming{0};  ///< velocity of the surface by its deformation, in the frame

        [[nodiscard]] glm::vec3 at(float share) const { return from + share * (to - from); }
    };
    /// The vehicle's body, a wheel, or a solid that moves.
    struct Carried {
        std::optional<std::size_t> solid{};  ///< its number
        bool stands = false;                 ///< a solid that does not move in this step: one of `solids_`
        CarriedFrame frame{};
        Box local{}, swept{};    ///< `swept`: on its way through the step
        glm::vec3 spin{0};       ///< rad/s about the origin, in the frame that does not spin
        float radiusMetres = 0;  ///< of a wheel; 0: another
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
        glm::vec3 normal{0, 1, 0};         ///< in the frame of what was met
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
    const scene::Scene* scene_ = nullptr;            ///< what was built
    meshes::TriangleTree solids_;                    ///< those that are still, or stand in this step
    std::optional<std::set<std::size_t>> standing_;  ///< of those that can move, the ones in `solids_`
    Box solidsBox_, carriedBox_;
    std::vector<Carried> carried_;
    float extentMetres_ = 0;
};

}  // namespace dustbench::particles
