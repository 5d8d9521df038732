// A lattice of particles: columns × rows × layers points per piece, each known by its serial number.
//
// Particles are numbered along columns, then rows, then layers, then pieces. Parts that link neighbours or draw a
// surface find them by number, wherever the particles have moved and in whatever order they are stored.
//
// Units: m. Frame: world, or the vehicle's if it carries the lattice.
// Source: Thesis, 5.4.1 (springs between adjacent particles).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"

namespace dustbench::particles {

struct Lattice {
    glm::ivec3 points{1};                    ///< columns, rows, layers
    glm::dvec3 place{0};                     ///< of the first point
    glm::dvec3 column{0}, row{0}, layer{0};  ///< from a point to the next one
    glm::dvec3 piece{0};                     ///< from a piece to the next one
    bool onVehicle = false;

    static void declare(ParameterSet& set);
    /// Throws InputError if two neighbours would be at the same place.
    static Lattice from(const ParameterValues& values);

    /// Points of a piece.
    [[nodiscard]] std::uint64_t size() const {
        return static_cast<std::uint64_t>(points.x) * static_cast<std::uint64_t>(points.y) *
               static_cast<std::uint64_t>(points.z);
    }
    /// Column, row and layer of a particle within its piece.
    [[nodiscard]] glm::ivec3 nodeOf(std::uint64_t serial) const {
        const auto within = static_cast<int>(serial % size());
        return {within % points.x, within / points.x % points.y, within / (points.x * points.y)};
    }
    /// Position at rest, in the frame of the lattice.
    [[nodiscard]] glm::dvec3 restOf(std::uint64_t serial) const {
        const glm::dvec3 node(nodeOf(serial));
        const auto repeat = serial / size();
        return place + node.x * column + node.y * row + node.z * layer + static_cast<double>(repeat) * piece;
    }
    /// From the frame of the lattice to the world at the end of the step.
    [[nodiscard]] glm::dmat4 toWorld(const scene::SceneState& state) const {
        return onVehicle ? state.vehicle.toWorld() : glm::dmat4(1);
    }
};

}  // namespace dustbench::particles
