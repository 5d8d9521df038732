// The ground holds particles up and slows what slides on it.
//
// A centre stays at least `lift`·radius above the ground below it (a puff is soft: it may sink in). Where it would go
// lower it is put there, loses the velocity into the ground, v ← v − (v·n)n if v·n < 0, and what is left decays with
// the rate `friction` (implicitly: v ← v/(1 + k·dt)). Source: Thesis, 5.3 (contact forces). Departs: position and
// velocity are put right after the move.
#pragma once

#include "methods/shared/particles/force_part.h"

namespace dustbench::particles {

class Ground : public ForcePart {
 public:
    static PartInfo describe();
    explicit Ground(const ParameterValues& values);

    void touch(Chunk& chunk, const Step& step) const override;

 private:
    float lift_;
    double frictionPerSecond_;
};

}  // namespace dustbench::particles
