// A radius drawn at birth, average + R·variation with R in [−1, 1), and kept.
//
// Source: Thesis, 4.5.
#pragma once

#include "methods/shared/particles/size_part.h"

namespace dustbench::particles {

class RandomSize : public SizePart {
 public:
    static PartInfo describe();
    /// Throws InputError where a radius could fall below 0.
    explicit RandomSize(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override;

 private:
    float averageMetres_, variationMetres_;
};

}  // namespace dustbench::particles
