// Velocities within a cone, as fast as the vehicle makes them, plus a share of the velocity of what carries the source.
//
//     v = (speed + speed_share·S)·(1 + R·variation)·D + inherit·V
//
// D: within half_angle of `direction`, S: the emitter's speed, V: its velocity, R in [−1, 1).
// Frame of `direction`: the emitter's, x forward, y up, z right.
// Source: Thesis, 4.3.2 and 4.3.1 ((avg + R·var)·D); Carr2006, 2.1 (start velocity grows with the car's speed).
#pragma once

#include "methods/shared/maths/sampling.h"
#include "methods/shared/particles/velocity_part.h"

namespace dustbench::particles {

class ConeVelocity : public VelocityPart {
 public:
    static PartInfo describe();
    /// Throws InputError for a direction of no length.
    explicit ConeVelocity(const ParameterValues& values);

    void launch(Newborns& newborns, const Step& step) const override;

 private:
    maths::Cone cone_;
    float speed_, speedShare_, variation_, inherit_;
};

}  // namespace dustbench::particles
