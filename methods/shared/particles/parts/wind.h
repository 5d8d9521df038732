// The scene's wind, with gusts that make a cloud billow. It moves the air; drag passes that on to the particles.
//
// The gusts are those of maths/turbulence.h.
#pragma once

#include "methods/shared/maths/turbulence.h"
#include "methods/shared/particles/force_part.h"

namespace dustbench::particles {

class Wind : public ForcePart {
 public:
    static PartInfo describe();
    explicit Wind(const ParameterValues& values);

    void begin(const Step& step) override;
    void blow(Chunk& chunk, const Step& step) const override;

 private:
    double factor_, gustSpeed_, gustMetres_, gustSeconds_;
    glm::vec3 wind_{0};       ///< of this step, m/s
    maths::GustField gusts_;  ///< of this step
};

}  // namespace dustbench::particles
