// A camera and the size of its image.
//
// Units: metres, radians. Frame: world. Depth: reversed (near 1, infinity 0), range [0, 1], infinite far plane.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::scene {

struct Camera {
    glm::dvec3 eye{0, 2, 10};
    glm::dvec3 target{0, 1, 0};
    glm::dvec3 up{0, 1, 0};
    double verticalFieldOfView = 0.9;
    double nearMetres = 0.1;
};

struct DUSTBENCH_API View {
    Camera camera;
    int width = 640;
    int height = 480;

    [[nodiscard]] glm::mat4 worldToEye() const;
    /// Eye space to clip space, reversed depth with an infinite far plane: depth = near / distance along the axis.
    [[nodiscard]] glm::mat4 eyeToClip() const;
    [[nodiscard]] glm::mat4 worldToClip() const { return eyeToClip() * worldToEye(); }
    /// Unit direction in the world of the ray through a pixel. (0, 0) is the top left corner; pixel centres are at
    /// +0.5.
    [[nodiscard]] glm::vec3 rayDirection(double pixelX, double pixelY) const;
};

}  // namespace dustbench::scene
