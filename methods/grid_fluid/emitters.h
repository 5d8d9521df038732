// Converts the sources of a fluid's file into balls in the world for each step, and finds how much dust the wheels
// raise.
//
// Units: SI; m² of optical mass (∫ extinction dV). Frame: world. Threads: one at a time. Source: Senger2009, 4.3: a
// sinusoid in time with a random factor. Departs: the random factor is drawn for each ball and step from Philox, and
// each ball has its own phase.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/method.h"
#include "methods/contract/volume.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/fluid_setup.h"

namespace dustbench::grid_fluid {

// --- The rate at which the wheels raise dust: the mean optical mass that births add to the shared dust. Each puff born
// in a step adds the mean mass of a puff of the shared cloud at that moment; the fluid's density decays at 1/mean
// lifetime per second. Both clouds then hold the same mass, births·lifetime·mean mass, within the fluid's box.

/// Mean mass of a cloud's puffs. In large clouds only every n-th puff is used.
[[nodiscard]] double meanPuffMassSquareMetres(const Puffs& dust);
/// Mean lifetime of a puff; 0 for an empty cloud.
[[nodiscard]] double meanLifetimeSeconds(const Puffs& dust);
/// Number of puffs born within the last step.
[[nodiscard]] std::size_t bornWithin(const Puffs& dust, double stepSeconds);

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
