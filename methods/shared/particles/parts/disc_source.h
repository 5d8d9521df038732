// Births spread evenly over a disc that lies in the plane of its emitter.
//
// Source: Thesis, 4.2.4.
#pragma once

#include "methods/shared/particles/parts/placed_source.h"

namespace dustbench::particles {

class DiscSource : public PlacedSource {
 public:
    static PartInfo describe();
    explicit DiscSource(const ParameterValues& values);

    void place(Newborns& newborns, const Step& step) const override;

 private:
    float radiusMetres_;
};

}  // namespace dustbench::particles
