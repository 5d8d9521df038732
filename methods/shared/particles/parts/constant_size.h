// One radius for all particles, all their life.
//
// Source: Thesis, 4.5.
#pragma once

#include "methods/shared/particles/size_part.h"

namespace dustbench::particles {

class ConstantSize : public SizePart {
 public:
    static PartInfo describe();
    explicit ConstantSize(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override;

 private:
    float radiusMetres_;
};

}  // namespace dustbench::particles
