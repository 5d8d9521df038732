// Births distributed uniformly along a line: P = P0 + rand·length·D.
//
// Frame of `direction`: the emitter's; x forward, y up, z right.
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::position::line {
namespace {

enum class Base { end, middle };
constexpr Choices<Base> bases{{"end", Base::end}, {"middle", Base::middle}};

class LineSource final : public PlacedSource {
 public:
    /// Throws InputError for a direction of zero length.
    explicit LineSource(const ParameterValues& values);

    void place(Newborns& newborns, const Step& step) const override;

 private:
    glm::vec3 direction_;
    float lengthMetres_, first_;
};

LineSource::LineSource(const ParameterValues& values)
    : PlacedSource(values),
      direction_(directionOf(values, "direction")),
      lengthMetres_(static_cast<float>(values.real("length_metres"))),
      first_(values.choice("base", bases) == Base::middle ? -0.5f : 0.0f) {}

void LineSource::place(Newborns& newborns, const Step& step) const {
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) {
        const float u = maths::uniform4(step.seed, positionStream, newborns.chunk.serial[i])[0];
        const glm::vec3 along = newborns.emitter[i]->toWorld(direction_);
        newborns.setPosition(i, newborns.centre(i) + (first_ + u) * lengthMetres_ * along);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a line that starts at its place or is centred on it";
    info.source = "Thesis, 4.2.2";
    PlacedSource::declare(info.parameters);
    declareVector(info.parameters, "direction", spaceAxes, {0, 0, 1}, -1, 1, "", "direction: forward, up, right");
    info.parameters.real("length_metres", 1, 0, 1e4, "m", "length of the line")
        .choice("base", Base::end, bases, "whether the place is the line's end or its middle");
    info.create = [](const ParameterValues& values) { return std::make_unique<LineSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::line
