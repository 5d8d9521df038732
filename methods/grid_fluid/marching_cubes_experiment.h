// Counts the ways in which a surface crosses a cell whose corners are inside or outside: 2⁸, and the classes under
// rotations and reflections of the cube and an exchange of inside and outside (claim R36).
//
// Threads: pure. Source: Senger2009, 3.3; Lorensen1987.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::marching_cubes {

/// Number of classes of the 256 ways.
[[nodiscard]] int classesOf(bool withMirrors, bool withExchange);

/// The experiment `marching_cubes`:
///     turns_and_exchange    as the algorithm counts them
///     turns                 control: inside and outside distinguished
///     turns_mirrors_and_exchange
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::marching_cubes
