// The setup of a fluid: box, forces, sources and appearance; plain data, from data/fluids. And the position of its box.
//
// Units: SI, radians. Frame: world. Colours: linear RGB. Threads: pure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/forces.h"

namespace dustbench::grid_fluid {

enum class SourceAt {
    point,   ///< a ball in the world
    solid,   ///< balls distributed over the surface of one of the scene's solids
    wheels,  ///< at the contact point of each of the vehicle's wheels
};
inline constexpr Choices<SourceAt> sourcePlaces{
    {"point", SourceAt::point}, {"solid", SourceAt::solid}, {"wheels", SourceAt::wheels}};

/// Strength at the centre; it oscillates in time: (1 − swing) + swing·(½ + ½ sin), times a random factor 1 ± chance.
struct SourceSetup {
    SourceAt at = SourceAt::point;
    glm::dvec3 centreMetres{0};
    std::string solid;
    int balls = 1;
    double radiusMetres = 0.5;
    float densityPerSecond = 0;
    float kelvinPerSecond = 0;
    float reaction = 0;
    glm::vec3 velocity{0};  ///< m/s; of wheels: ahead, up, right
    float velocityPerSecond = 0;
    float swing = 0, swingSeconds = 1, chance = 0;
    // For wheels only; the amount of dust follows the shared cloud, see emitters.h.
    float speedShare = 0;  ///< share of the vehicle's speed, added to |velocity| along it
    float inherit = 0;     ///< share of the wheel's own velocity
};

struct FluidLook {
    double extinctionPerMetre = 1;    ///< at a density of 1
    std::optional<glm::vec3> albedo;  ///< empty: the scene's dust
    int shadowCells = 0;              ///< blocks of the light volume; 0: no shadows
    std::filesystem::path fire;       ///< transfer function of the reaction; empty: no fire
};

struct FluidSetup {
    std::string name, description;
    bool followsVehicle = false;
    glm::dvec3 middleMetres{0};  ///< centre of the floor, for a stationary box
    double lengthMetres = 12.8;  ///< of the box along x; the cells are cubes
    double aheadMetres = 5;      ///< distance ahead of the vehicle's rear axle, for a following box
    double belowMetres = 0;      ///< depth of the box below the vehicle on uneven ground
    flow::ForceSettings forces;
    bool noSlip = false;
    bool keepsDensity = false;
    std::vector<SourceSetup> sources;
    FluidLook look;
};

/// Throws InputError with file and line.
[[nodiscard]] FluidSetup readFluid(const std::filesystem::path& file);

// --- The box is stationary, or follows the vehicle by whole cells, so that its lattice stays fixed in the world

/// The desired minimum corner, on the lattice of the box. A following box keeps the vehicle near the end in the driving
/// direction; its floor is the ground if the ground is level.
[[nodiscard]] glm::dvec3 wantedOrigin(const FluidSetup& setup, const flow::FluidBox& box, const scene::Terrain& terrain,
                                      const scene::VehicleState& vehicle);

/// Number of cells to move the box: zero until a minimum distance along an axis is reached, then the whole distance.
[[nodiscard]] glm::ivec3 dueScroll(const flow::FluidBox& box, const glm::dvec3& wantedOrigin);

}  // namespace dustbench::grid_fluid
