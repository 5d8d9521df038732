// Measures the sentences of the thesis that call one way of computing particles cheaper than another (claims P3 to P6,
// P16).
//
// Units: m, m/s, s. Threads: one, whose CPU time is measured.
// Source: Thesis, 4.2.1 (point source), 4.2.3 (rejection), 4.4.1 (constant colour), 5.3.2 (bounce), 6.1.5 (meshes).
#pragma once

#include <cstdint>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::particles::part_costs {

/// How large an experiment is.
struct Sizes {
    std::size_t particles, paths;  ///< in a system; of particles that move near a mesh
    int repetitions;
};

/// The experiment `part_costs`. Every finding is a ratio of two times that are measured in turn.
///
/// rejection_over_angles: uniform points in a ball, by rejection from its cube over spherical coordinates
/// (d = ∛u, cos θ = 1 − 2v, φ = 2πw), one call per point, from the same table of random numbers;
/// rejection_over_two_rejections, rejection_of_equals: controls.
/// point_over_line_source, …_disc_…, …_ball_…: steps of a system in which all particles are born in each step;
/// ball_over_point_source: a control.
/// constant_over_linear_colour: steps of a system without forces; constant_over_six_points_colour,
/// colour_of_equals: controls.
/// bounce_printed_over_exact: steps of a system on two discs, at the current place as printed over at the point of
/// impact; one_bounce_over_eight, bounce_of_equals: controls.
/// sphere_over_facets, tree_over_sphere: paths of particles near a mesh of 1,280 triangles: a bounding sphere before
/// all facets over all facets, and a tree of boxes over the sphere; facets_of_equals: a control. hits_of_sphere,
/// hits_of_tree: the hits that each finds over those of all facets.
[[nodiscard]] DUSTBENCH_API ExperimentInfo describe();
[[nodiscard]] std::vector<Finding> measurePartCosts(std::uint64_t seed, const Sizes& sizes);

}  // namespace dustbench::particles::part_costs
