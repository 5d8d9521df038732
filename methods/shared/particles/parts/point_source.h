// Births at a point.
//
// Source: Thesis, 4.2.1.
#pragma once

#include "methods/shared/particles/parts/placed_source.h"

namespace dustbench::particles {

class PointSource : public PlacedSource {
 public:
    static PartInfo describe();
    explicit PointSource(const ParameterValues& values) : PlacedSource("point", values) {}

    void place(Newborns& newborns, const Step& step) const override;
};

}  // namespace dustbench::particles
