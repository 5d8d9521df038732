#include "methods/kit/particles/lattice.h"

#include <string>

#include "methods/contract/choices.h"
#include "methods/contract/errors.h"
#include "methods/kit/particles/vector_parameter.h"

namespace dustbench::particles {
namespace {

constexpr Choices<bool> latticeFrames{{"world", false}, {"vehicle", true}};

glm::dvec3 stepOf(const ParameterValues& values, const std::string& name, int points) {
    const glm::dvec3 step = vectorOf(values, name, spaceAxes);
    if (points > 1 && !(glm::length(step) >= 1e-4))
        throw InputError("parameter " + name + ": got a length of " + std::to_string(glm::length(step)) +
                         " m, allowed: at least 0.0001 m");
    return step;
}

}  // namespace

void Lattice::declare(ParameterSet& set) {
    set.integer("columns", 20, 1, 4096, "", "points along the first axis")
        .integer("rows", 20, 1, 4096, "", "points along the second axis")
        .integer("layers", 1, 1, 256, "", "points along the third axis; 1: a surface")
        .choice("frame", false, latticeFrames, "the frame of all positions: the world's or the vehicle's");
    declareVector(set, "place", spaceAxes, {0, 2, 0}, -1e6, 1e6, "m", "position of the first point");
    declareVector(set, "column_step", spaceAxes, {0.05, 0, 0}, -1e3, 1e3, "m", "from a column to the next");
    declareVector(set, "row_step", spaceAxes, {0, -0.05, 0}, -1e3, 1e3, "m", "from a row to the next");
    declareVector(set, "layer_step", spaceAxes, {0, 0, 0.05}, -1e3, 1e3, "m", "from a layer to the next");
    declareVector(set, "piece_step", spaceAxes, {0, 0, 0.5}, -1e6, 1e6, "m",
                  "from a piece to the next: particles beyond columns × rows × layers form further pieces");
}

Lattice Lattice::from(const ParameterValues& values) {
    Lattice lattice;
    lattice.points = {static_cast<int>(values.integer("columns")), static_cast<int>(values.integer("rows")),
                      static_cast<int>(values.integer("layers"))};
    lattice.place = vectorOf(values, "place", spaceAxes);
    lattice.column = stepOf(values, "column_step", lattice.points.x);
    lattice.row = stepOf(values, "row_step", lattice.points.y);
    lattice.layer = stepOf(values, "layer_step", lattice.points.z);
    lattice.piece = vectorOf(values, "piece_step", spaceAxes);
    lattice.onVehicle = values.choice("frame", latticeFrames);
    constexpr std::uint64_t maximum = 1 << 28;
    if (lattice.size() > maximum)
        throw InputError("parameter columns: got " + std::to_string(lattice.size()) +
                         " points (columns × rows × layers), allowed: at most " + std::to_string(maximum));
    return lattice;
}

}  // namespace dustbench::particles
