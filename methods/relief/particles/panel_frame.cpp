#include "methods/relief/particles/panel_frame.h"

#include <stdexcept>

namespace dustbench::relief {
namespace {

/// Inverts a rotation and translation.
glm::dmat4 rigidInverse(const glm::dmat4& pose) {
    const glm::dmat3 back = glm::transpose(glm::dmat3(pose));
    glm::dmat4 inverse(back);
    inverse[3] = glm::dvec4(-(back * glm::dvec3(pose[3])), 1);
    return inverse;
}

glm::dvec3 placed(const glm::dmat4& pose, const glm::dvec3& place) {
    return glm::dvec3(pose * glm::dvec4(place, 1));
}

}  // namespace

PanelFrame::PanelFrame(const glm::dmat4& toWorldBefore, const glm::dmat4& toWorldAfter, double seconds)
    : before_(toWorldBefore),
      after_(toWorldAfter),
      fromWorldBefore_(rigidInverse(toWorldBefore)),
      fromWorldAfter_(rigidInverse(toWorldAfter)),
      seconds_(seconds) {
    if (!(seconds > 0)) throw std::invalid_argument("PanelFrame: a step must be longer than 0 s");
}

/// The panel's mean velocity over the step at this place, in the world.
glm::dvec3 PanelFrame::velocityAt(const glm::dvec3& panelPlace) const {
    return (placed(after_, panelPlace) - placed(before_, panelPlace)) / seconds_;
}

Moving PanelFrame::toPanel(const Moving& world) const {
    const glm::dvec3 place = placed(fromWorldAfter_, world.place);
    return {place, directionToPanel(world.velocity - velocityAt(place))};
}

Moving PanelFrame::toWorld(const Moving& panel) const {
    return {placed(after_, panel.place), glm::dmat3(after_) * panel.velocity + velocityAt(panel.place)};
}

glm::dvec3 PanelFrame::toPanelBefore(const glm::dvec3& world) const {
    return placed(fromWorldBefore_, world);
}

glm::dvec3 PanelFrame::directionToPanel(const glm::dvec3& world) const {
    return glm::dmat3(fromWorldAfter_) * world;
}

}  // namespace dustbench::relief
