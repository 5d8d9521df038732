// Death by distance: farther than a reach from a place, or from the nearest of the vehicle's wheels.
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::life::out_of_reach {
namespace {

enum class From { wheels, place };
constexpr Choices<From> origins{{"wheels", From::wheels}, {"place", From::place}};

class OutOfReach final : public LifePart {
 public:
    explicit OutOfReach(const ParameterValues& values)
        : LifePart(values),
          from_(values.choice("from", origins)),
          place_(vectorOf(values, "place", spaceAxes)),
          reach_(static_cast<float>(values.real("reach_metres"))) {}

    void evaluate(Chunk& chunk, const Step& step) const override;

 private:
    [[nodiscard]] bool isNear(const glm::vec3& point, const glm::vec3& origin) const {
        const glm::vec3 way = point - origin;
        return glm::dot(way, way) <= reach_ * reach_;
    }

    From from_;
    glm::vec3 place_;
    float reach_;
};

void OutOfReach::evaluate(Chunk& chunk, const Step& step) const {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3 point(chunk.x[i], chunk.y[i], chunk.z[i]);
        bool near = from_ == From::place && isNear(point, place_);
        if (from_ == From::wheels)
            for (const Emitter& wheel : step.wheels) near = near || isNear(point, wheel.to);
        if (!near) chunk.dead[i] = 1;
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "death too far from the source, in addition to death by age";
    info.source = "Senger2009, 5";
    info.parameters.choice("from", From::place, origins, "distance from `place`, or from the nearest wheel");
    declareVector(info.parameters, "place", spaceAxes, {0, 0, 0}, -1e6, 1e6, "m", "position in the world");
    info.parameters.real("reach_metres", 5, 0, 1e6, "m", "a particle dies farther than this from there");
    info.create = [](const ParameterValues& values) { return std::make_unique<OutOfReach>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::life::out_of_reach
