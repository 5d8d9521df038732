// Converts the sources of a fluid's file into balls in the world for each step.
//
// Units: SI. Frame: world. Threads: one at a time. Source: Senger2009, 4.3: a sinusoid in time with a random factor.
// Departs: the random factor is drawn for each ball and step from Philox, and each ball has its own phase.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/method.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/fluid_setup.h"

namespace dustbench::grid_fluid {

class Emitters {
 public:
    /// `setups` and `scene` must outlive this. Throws InputError if the scene lacks the object that a source is
    /// attached to.
    Emitters(const std::vector<SourceSetup>& setups, const scene::Scene& scene, std::uint64_t seed);

    /// The sources at this step; `dustM2` is the optical mass that all wheels together raise in `stepSeconds`.
    [[nodiscard]] std::span<const flow::FluidSource> at(const scene::SceneState& state, std::int64_t step,
                                                        double stepSeconds, double dustM2);

 private:
    /// A point of a solid's surface.
    struct Place {
        std::size_t solid;
        std::size_t first;   ///< of the triangle's three indices
        glm::dvec3 weights;  ///< of its corners
    };
    struct Ball {
        glm::dvec3 centre;
        const SourceSetup* setup;
        float phase;                   ///< of its oscillation, in periods
        std::optional<Place> place{};  ///< on a moving solid, which carries it
    };
    [[nodiscard]] glm::dvec3 centreOf(const Ball& ball, const scene::SceneState& state) const;
    void scatterOver(const SourceSetup& setup, const scene::Scene& scene);
    void addWheels(const SourceSetup& setup, const scene::SceneState& state, double stepSeconds, double dustM2);

    const std::vector<SourceSetup>& setups_;
    const scene::Scene& scene_;
    std::uint64_t seed_;
    std::vector<Ball> balls_;
    std::vector<flow::FluidSource> sources_;
};

}  // namespace dustbench::grid_fluid
