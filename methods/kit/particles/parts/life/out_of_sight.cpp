// Death outside the picture: farther than a margin from the pyramid that the camera sees, or too far from the camera.
//
// In the camera's frame, with d along its axis and t the tangent of half its field of view, a side of the pyramid is at
// the distance (|x| − t·d)/√(1 + t²). A particle has the radius of its puff, 1.5·r (3s of the Gaussian).
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::life::out_of_sight {
namespace {

/// The camera's frame and the half angles of its picture.
struct Sight {
    glm::vec3 eye, right, up, ahead;
    float tangentX, tangentY;
};

Sight sightOf(const scene::View& view) {
    const scene::Camera& c = view.camera;
    const glm::dvec3 ahead = glm::normalize(c.target - c.eye), right = glm::normalize(glm::cross(ahead, c.up));
    const double tangent = std::tan(c.verticalFieldOfView / 2);
    return {c.eye,
            right,
            glm::cross(right, ahead),
            ahead,
            static_cast<float>(tangent * view.width / view.height),
            static_cast<float>(tangent)};
}

/// Distance from a side of the pyramid, positive outside.
float beyondSide(float across, float along, float tangent) {
    return (std::fabs(across) - tangent * along) / std::sqrt(1 + tangent * tangent);
}

class OutOfSight final : public LifePart {
 public:
    explicit OutOfSight(const ParameterValues& values)
        : LifePart(values),
          margin_(static_cast<float>(values.real("margin_metres"))),
          farthest_(static_cast<float>(values.real("farthest_metres"))) {}

    /// Throws InputError without a camera.
    void begin(const Step& step) override;
    void evaluate(Chunk& chunk, const Step& step) const override;

 private:
    float margin_, farthest_;
    Sight sight_{};
};

void OutOfSight::begin(const Step& step) {
    if (!step.view)
        throw InputError(
            "life out_of_sight: got dust that all methods share, which has no camera, allowed: a system of the method "
            "plugin_particles");
    sight_ = sightOf(*step.view);
}

void OutOfSight::evaluate(Chunk& chunk, const Step&) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3 to = glm::vec3(chunk.x[i], chunk.y[i], chunk.z[i]) - sight_.eye;
        const float along = glm::dot(to, sight_.ahead), room = margin_ + 1.5f * chunk.radius[i];
        const bool unseen = -along > room || beyondSide(glm::dot(to, sight_.right), along, sight_.tangentX) > room ||
                            beyondSide(glm::dot(to, sight_.up), along, sight_.tangentY) > room ||
                            (farthest_ > 0 && glm::length(to) - room > farthest_);
        if (unseen) chunk.dead[i] = 1;
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "death outside the camera's picture; the state then depends on the camera and the picture's shape";
    info.source = "Thesis, 4.7.3";
    info.parameters.real("margin_metres", 0.5, 0, 1e6, "m", "a particle dies farther than this outside the picture")
        .real("farthest_metres", 0, 0, 1e6, "m", "a particle dies farther than this from the camera; 0: no limit");
    info.create = [](const ParameterValues& values) { return std::make_unique<OutOfSight>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::life::out_of_sight
