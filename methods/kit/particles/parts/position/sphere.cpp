// Births in a ball: uniform, by rejection or exactly, or dense at the centre.
//
// rejection: points of the surrounding cube until one lies in the ball. exact: the same distribution from five numbers.
// centre: both angles and the distance uniform, so that the density falls as 1/d².
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::position::sphere {
namespace {

enum class Mode { rejection, exact, centre };
constexpr Choices<Mode> modes{{"rejection", Mode::rejection}, {"exact", Mode::exact}, {"centre", Mode::centre}};

/// In the unit ball.
glm::vec3 pointOf(Mode mode, std::uint64_t seed, std::uint64_t serial) {
    const auto draw = [&](std::uint32_t k) { return maths::uniform4(seed, positionStream, serial, k); };
    if (mode == Mode::rejection)
        return maths::ballPointByRejection([&](std::uint32_t k) {
            const auto u = draw(k);
            return glm::vec3(maths::centred(u[0]), maths::centred(u[1]), maths::centred(u[2]));
        });
    const auto u = draw(0);
    if (mode == Mode::centre) return maths::denseBallPoint(u[0], u[1], u[2]);
    return maths::ballPoint(u[0], u[1], u[2], u[3], draw(1)[0]);
}

class SphereSource final : public PlacedSource {
 public:
    explicit SphereSource(const ParameterValues& values);

    void place(Newborns& newborns, const Step& step) const override;

 private:
    Mode mode_;
    float radiusMetres_;
};

SphereSource::SphereSource(const ParameterValues& values)
    : PlacedSource(values),
      mode_(values.choice("mode", modes)),
      radiusMetres_(static_cast<float>(values.real("radius_metres"))) {}

void SphereSource::place(Newborns& newborns, const Step& step) const {
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) {
        const glm::vec3 local = radiusMetres_ * pointOf(mode_, step.seed, newborns.chunk.serial[i]);
        newborns.setPosition(i, newborns.centre(i) + newborns.emitter[i]->toWorld(local));
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a ball, filled evenly or dense at its centre";
    info.source = "Thesis, 4.2.3";
    PlacedSource::declare(info.parameters);
    info.parameters
        .choice("mode", Mode::exact, modes,
                "rejection: evenly, the paper's way; exact: evenly, by a formula; centre: the paper's `normal` "
                "distribution, whose density falls as 1/d² and is higher near the poles")
        .real("radius_metres", 0.5, 0, 1e4, "m", "radius of the ball");
    info.create = [](const ParameterValues& values) { return std::make_unique<SphereSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::sphere
