// Base of all sources: placed at the vehicle's wheels, or at a fixed position in the world.
#pragma once

#include "methods/kit/particles/position_part.h"

namespace dustbench::particles {

class PlacedSource : public PositionPart {
 public:
    static void declare(ParameterSet& set);
    explicit PlacedSource(const ParameterValues& values);

    [[nodiscard]] std::span<const Emitter> emitters(const Step& step) const override;

 private:
    enum class At { wheels, place };
    static constexpr Choices<At> places{{"wheels", At::wheels}, {"place", At::place}};

    At at_;
    Emitter place_;
};

}  // namespace dustbench::particles
