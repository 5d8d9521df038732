// Transforms positions and velocities between the world and the frame of a panel, which may move and turn.
//
// Units: m, m/s. Threads: pure. Source: Bergeron, 5 (as future work).
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/scene.h"

namespace dustbench::relief {

/// Position and velocity in one frame.
struct Moving {
    glm::dvec3 place{0}, velocity{0};
};

/// A panel's pose at the beginning and at the end of a step.
class PanelFrame {
 public:
    PanelFrame() = default;
    PanelFrame(const glm::dmat4& toWorldBefore, const glm::dmat4& toWorldAfter, double seconds);

    /// Transforms at the end of the step. The velocity is relative to the panel's own at that place.
    [[nodiscard]] Moving toPanel(const Moving& world) const;
    /// The inverse of `toPanel`.
    [[nodiscard]] Moving toWorld(const Moving& panel) const;
    /// Transforms a place at the beginning of the step.
    [[nodiscard]] glm::dvec3 toPanelBefore(const glm::dvec3& world) const;
    /// Transforms a direction of the world, such as gravity, at the end of the step.
    [[nodiscard]] glm::dvec3 directionToPanel(const glm::dvec3& world) const;

 private:
    [[nodiscard]] glm::dvec3 velocityAt(const glm::dvec3& panelPlace) const;

    glm::dmat4 before_{1}, after_{1};
    glm::dmat4 fromWorldBefore_{1}, fromWorldAfter_{1};
    double seconds_ = 1;
};

}  // namespace dustbench::relief
