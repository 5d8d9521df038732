// What a scene holds as one surface: its ground, its solids, and the moving vehicle.
//
// Ground and wheels are met from outside; the triangles of solids and of the vehicle's body from both sides. A wheel is
// the cylinder of its outline, whatever its spokes, and turns: its surface moves with its spin. Panels are not met.
//
// Units: m, m/s, s. Frame: world. Owns: the triangles' trees. Threads: `meet` and `touchAt` are safe from any.
#pragma once

#include <optional>

#include "methods/kit/meshes/triangle_tree.h"
#include "methods/kit/particles/carried_frame.h"
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
    [[nodiscard]] std::size_t bytes() const override { return solids_.bytes() + body_.bytes(); }

 private:
    struct Box {
        glm::vec3 minimum{INFINITY}, maximum{-INFINITY};
        void take(const glm::vec3& point);
        void take(const Box& other);
        [[nodiscard]] bool meets(const glm::vec3& from, const glm::vec3& to) const;
    };
    /// The vehicle's body or a wheel.
    struct Carried {
        CarriedFrame frame;
        Box local, swept;        ///< `swept`: on its way through the step
        glm::vec3 spin{0};       ///< rad/s about the origin, in the frame that does not spin
        float radiusMetres = 0;  ///< of a wheel; 0: the body
        float halfWidthMetres = 0;

        void moveTo(const glm::dmat4& toWorld, const glm::dvec3& velocity, double stepSeconds);
    };
    struct Found {
        float share = none;
        const Carried* carried = nullptr;  ///< null: ground or solids
        glm::vec3 normal{0, 1, 0};         ///< in the frame of what was met
    };

    void build(const scene::Scene& scene);
    void moveVehicle(const Step& step);
    [[nodiscard]] Found find(const Meeting& way, float groundShare) const;
    [[nodiscard]] Found findOn(const Carried& carried, const Meeting& way) const;

    SceneParts parts_;
    const scene::Scene* scene_ = nullptr;  ///< what was built
    meshes::TriangleTree solids_, body_;
    Box solidsBox_, vehicleBox_;
    std::vector<Carried> carried_;
    float extentMetres_ = 0;
};

}  // namespace dustbench::particles
