// A steady stream of births, at a rate that may grow with the vehicle's speed; fractions are carried over.
//
// rate = rate_per_second + rate_per_metre·speed. Births fall where the running count passes a whole number, so that
// they are evenly spaced in time whatever the step. Source: Thesis, 4.6.1 (the fractional accumulator). Departs: each
// birth has its moment within the step.
#pragma once

#include "methods/shared/particles/emission_part.h"

namespace dustbench::particles {

class Stream : public EmissionPart {
 public:
    static PartInfo describe();
    explicit Stream(const ParameterValues& values);

    [[nodiscard]] Births births(const Step& step) override;

 private:
    double ratePerSecond_, ratePerMetre_;
    double carried_ = 0;  ///< the part of a particle that is due already, [0, 1)
};

}  // namespace dustbench::particles
