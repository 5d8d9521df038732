// Air resistance, linear in the velocity relative to the air: a = k·(u − v).
//
// Never more than what takes a particle to the air's velocity in one step, k·dt ≤ 1: so it is stable at any rate, and
// a falling particle's last speed is g/k whatever the step.
// Source: Thesis, 5 (air resistance is named, no formula given); Stokes' law for grains as small as dust.
#pragma once

#include "methods/shared/particles/force_part.h"

namespace dustbench::particles {

class Drag : public ForcePart {
 public:
    static PartInfo describe();
    explicit Drag(const ParameterValues& values);

    void push(Chunk& chunk, const Step& step) const override;

 private:
    double ratePerSecond_;
};

}  // namespace dustbench::particles
