// A constant acceleration downwards: gravity, less what buoyancy takes off.
//
// Source: Thesis, 5.2.1.
#pragma once

#include "methods/shared/particles/force_part.h"

namespace dustbench::particles {

class Gravity : public ForcePart {
 public:
    static PartInfo describe();
    explicit Gravity(const ParameterValues& values);

    void push(Chunk& chunk, const Step& step) const override;

 private:
    float acceleration_;
};

}  // namespace dustbench::particles
