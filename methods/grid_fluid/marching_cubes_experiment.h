// Counts the ways in which a surface crosses a cell whose corners are within or without: 2⁸, and those that turns of
// the cube, its mirror images and an exchange of within and without do not make of each other (claim R36).
//
// Threads: pure. Source: Senger2009, 3.3; Lorensen1987.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::marching_cubes {

/// Number of classes of the 256 ways.
[[nodiscard]] int classesOf(bool withMirrors, bool withExchange);

/// The experiment `marching_cubes`:
///     turns_and_exchange    as the algorithm counts them
///     turns                 control: inside and outside told apart
///     turns_mirrors_and_exchange
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::marching_cubes
