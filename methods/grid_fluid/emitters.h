// Turns what a fluid's file says of its sources into balls in the world, moment by moment.
//
// Units: SI. Frame: world. Threads: one at a time. Source: Senger2009, 4.3: a sinusoid in time, and chance.
// Departs: chance is drawn for each ball and step from Philox, and each ball swings in a phase of its own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/contract/method.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/fluid_setup.h"

namespace dustbench::grid_fluid {

class Emitters {
 public:
    /// Throws InputError where the scene lacks what a source sits on.
    Emitters(const std::vector<SourceSetup>& setups, const scene::Scene& scene, std::uint64_t seed);

    /// Of this moment; `dustM2` is the optical mass that all wheels together raise in `stepSeconds`.
    [[nodiscard]] std::span<const flow::FluidSource> at(const scene::SceneState& state, std::int64_t step,
                                                        double stepSeconds, double dustM2);

 private:
    /// A ball that stays where it is.
    struct Ball {
        glm::dvec3 centre;
        const SourceSetup* setup;
        float phase;  ///< of its swing, in turns
    };
    void scatterOver(const SourceSetup& setup, const scene::Scene& scene);
    void addWheels(const SourceSetup& setup, const scene::SceneState& state, double stepSeconds, double dustM2);

    const std::vector<SourceSetup>& setups_;
    std::uint64_t seed_;
    std::vector<Ball> balls_;
    std::vector<flow::FluidSource> sources_;
};

}  // namespace dustbench::grid_fluid
