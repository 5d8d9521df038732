// A radius that grows (or shrinks) along a straight line from birth to death.
//
// Source: Thesis, 4.5.
#pragma once

#include "methods/shared/particles/size_part.h"

namespace dustbench::particles {

class LinearSize : public SizePart {
 public:
    static PartInfo describe();
    explicit LinearSize(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override { update(chunk, step); }
    void update(Chunk& chunk, const Step& step) const override;

 private:
    float startMetres_, endMetres_;
};

}  // namespace dustbench::particles
