// Particles steer around a ball before they reach it, and never enter it.
//
// A particle that would pass the centre c at the distance q < R + m within the next `ahead_seconds` turns aside with
// the acceleration that clears the ball in time: a = 2·(R + m − q)/t² across its velocity, where it is abreast of the
// centre after t. What still reaches the ball slides along it.
#include <algorithm>
#include <cmath>

#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/surface_shapes.h"

namespace dustbench::particles::parts::force::avoid {
namespace {

struct Ball {
    glm::vec3 centre;
    float radiusMetres, marginMetres, aheadSeconds, maximum;

    [[nodiscard]] glm::vec3 steer(const glm::vec3& x, const glm::vec3& v) const;
};

glm::vec3 Ball::steer(const glm::vec3& x, const glm::vec3& v) const {
    const float speed = glm::length(v), clear = radiusMetres + marginMetres;
    if (speed == 0) return glm::vec3(0);
    const glm::vec3 forward = v / speed, to = centre - x;
    const float abreast = glm::dot(to, forward);
    if (abreast <= 0 || abreast - clear > speed * aheadSeconds) return glm::vec3(0);
    glm::vec3 aside = abreast * forward - to;  // from the centre to the nearest point of the path
    const float distance = glm::length(aside);
    if (distance >= clear) return glm::vec3(0);
    if (distance < 1e-6f * clear) {  // straight at the centre: any side will do
        aside = std::abs(forward.y) < 0.9f ? glm::cross(forward, glm::vec3(0, 1, 0)) : glm::vec3(1, 0, 0);
        aside -= glm::dot(aside, forward) * forward;
    }
    const float seconds = abreast / speed;
    const float needed = 2 * (clear - distance) / (seconds * seconds);
    return std::min(needed, maximum) * glm::normalize(aside);
}

class Avoid final : public ForcePart {
 public:
    explicit Avoid(const ParameterValues& values);

    void push(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] const Surface* surface() const override { return surface_.get(); }
    [[nodiscard]] std::optional<Mark> mark() const override {
        return markOf(values(), {MarkShape::ball, ball_.centre, {0, 1, 0}, ball_.radiusMetres});
    }
    [[nodiscard]] Contact contact() const override { return {.restitution = 0, .friction = 0}; }

 private:
    Ball ball_;
    std::unique_ptr<Surface> surface_;
};

Avoid::Avoid(const ParameterValues& values)
    : ForcePart(values),
      ball_{vectorOf(values, "place", spaceAxes), static_cast<float>(values.real("radius_metres")),
            static_cast<float>(values.real("margin_metres")), static_cast<float>(values.real("ahead_seconds")),
            static_cast<float>(values.real("maximum_acceleration"))},
      surface_(makeBall(ball_.centre, ball_.radiusMetres)) {}

void Avoid::push(Chunk& chunk, const Step&) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3 a = ball_.steer({chunk.x[i], chunk.y[i], chunk.z[i]},
                                        {chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]});
        chunk.accelerationX[i] += a.x;
        chunk.accelerationY[i] += a.y;
        chunk.accelerationZ[i] += a.z;
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "particles steer around a ball, and slide along it if they reach it";
    info.source = "Reynolds1987, 5; Reynolds1999";
    declareVector(info.parameters, "place", spaceAxes, {0, 2, 0}, -1e6, 1e6, "m", "centre of the ball");
    info.parameters.real("radius_metres", 0.5, 1e-3, 1e5, "m", "R: particles never enter it")
        .real("margin_metres", 0.2, 0, 1e5, "m", "m: they pass at least this far from it, if there is time")
        .real("ahead_seconds", 1, 0, 1e3, "s", "how far ahead they look")
        .real("maximum_acceleration", 30, 0, 1e5, "m/s²", "limit on the turn");
    declareMark(info.parameters, "a ball", {0.5, 0.5, 0.5});
    info.create = [](const ParameterValues& values) { return std::make_unique<Avoid>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::avoid
