// What all sources share: they sit at the vehicle's wheels, or at a place in the world.
#pragma once

#include "methods/kit/particles/position_part.h"

namespace dustbench::particles {

class PlacedSource : public PositionPart {
 public:
    static void declare(ParameterSet& set);
    explicit PlacedSource(const ParameterValues& values);

    [[nodiscard]] std::span<const Emitter> emitters(const Step& step) const override;

 protected:
    /// Where the emitter of newborn `i` was at its birth: on the straight line that it followed in the step.
    [[nodiscard]] static glm::vec3 centreOf(const Newborns& newborns, std::size_t i);

 private:
    enum class At { wheels, place };
    static constexpr Choices<At> places{{"wheels", At::wheels}, {"place", At::place}};

    At at_;
    Emitter place_;
};

}  // namespace dustbench::particles
