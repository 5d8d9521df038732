// What a fluid is: its box, what drives it, where it comes from and how it looks. Plain data, from data/fluids.
//
// Units: SI, radians. Colours: linear RGB.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/grid_fluid/flow/forces.h"

namespace dustbench::grid_fluid {

enum class SourceAt {
    point,   ///< a ball in the world
    solid,   ///< balls all over the surface of one of the scene's solids
    wheels,  ///< where each of the vehicle's wheels touches the ground
};
inline constexpr Choices<SourceAt> sourcePlaces{
    {"point", SourceAt::point}, {"solid", SourceAt::solid}, {"wheels", SourceAt::wheels}};

/// Strength at the centre; it swings with time: (1 − swing) + swing·(½ + ½ sin), times 1 ± chance.
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
    // Of wheels: their dust is that of the shared cloud, see dust_mass.h.
    float speedShare = 0;  ///< of the vehicle's, on top of |velocity| along it
    float inherit = 0;     ///< share of the wheel's own velocity
};

struct FluidLook {
    double extinctionPerMetre = 1;    ///< of a density of 1
    std::optional<glm::vec3> albedo;  ///< none: the scene's dust
    int shadowCells = 0;              ///< blocks of the light volume; 0: the sun shines through
    std::filesystem::path fire;       ///< transfer function of the reaction; empty: nothing burns
};

struct FluidSetup {
    std::string name, description;
    bool followsVehicle = false;
    glm::dvec3 middleMetres{0};  ///< of the floor, where the box stands still
    double lengthMetres = 12.8;  ///< of the box along x; the cells are cubes
    double aheadMetres = 5;      ///< of the vehicle's rear axle, of a box that follows it
    double belowMetres = 0;      ///< how far the box reaches below the vehicle on ground that is not level
    flow::ForceSettings forces;
    bool noSlip = false;
    bool keepsDensity = false;
    std::vector<SourceSetup> sources;
    FluidLook look;
};

/// Throws InputError with file and line.
[[nodiscard]] FluidSetup readFluid(const std::filesystem::path& file);

}  // namespace dustbench::grid_fluid
