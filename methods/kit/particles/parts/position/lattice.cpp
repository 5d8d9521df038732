// A lattice of columns × rows × layers, for springs and cloth.
//
// Source of the links between neighbours: kit/particles/lattice.h. Use with `bursts` of columns × rows × layers
// particles.
#include "methods/kit/particles/lattice.h"

#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::position::lattice {
namespace {

class LatticeSource final : public PositionPart {
 public:
    /// Throws InputError if two neighbours would be at the same place.
    explicit LatticeSource(const ParameterValues& values) : PositionPart(values), lattice_(Lattice::from(values)) {}

    /// On the vehicle, one of its wheels is the carrier, for velocities that inherit the vehicle's.
    [[nodiscard]] std::span<const Emitter> emitters(const Step& step) const override {
        return lattice_.onVehicle ? step.wheels.subspan(0, step.wheels.empty() ? 0 : 1) : std::span(&still_, 1);
    }
    void place(Newborns& newborns, const Step& step) const override;
    [[nodiscard]] const Lattice* lattice() const override { return &lattice_; }

 private:
    Lattice lattice_;
    Emitter still_;
};

/// Newborns drift until the end of the step: on a moving carrier they start as far back.
void LatticeSource::place(Newborns& newborns, const Step& step) const {
    const glm::dmat4 toWorld = lattice_.toWorld(step.state);
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) {
        const Emitter& carrier = *newborns.emitter[i];
        const glm::vec3 velocity = glm::mix(carrier.velocityFrom, carrier.velocityTo, newborns.moment[i]);
        const glm::dvec3 rest(toWorld * glm::dvec4(lattice_.restOf(newborns.chunk.serial[i]), 1));
        newborns.setPosition(i, glm::vec3(rest) - newborns.chunk.age[i] * velocity);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a lattice of columns × rows × layers, whose neighbours the force `springs` links";
    info.source = "Thesis, 5.4.1; Provot1995, 2";
    Lattice::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<LatticeSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::lattice
