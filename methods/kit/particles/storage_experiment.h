// Measures the cost of a linked list, of arrays and of a pool of dead particles (claim R22).
//
// Threads: one. Source: Thesis, 3.1.3 and 3.3.1.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::particles::storage {

/// The experiment `storage`: 100,000 particles, of which 1 in 200 dies per step, after 400 steps.
///
/// scan_list_over_soa, scan_aos_over_soa: time of a scan over that of the structure of arrays, all with a pool.
/// scan_list_over_aos: the cost of the links alone.
/// churn_without_over_with_list, …_aos, …_soa: time of removing dead particles and adding newborns, without the pool
/// over with it.
/// allocation_without_over_with_list: the same without the walk that finds the dead: time of freeing and allocating
/// nodes, over that of taking them from the pool.
/// churn_aos_over_list: the same for the array over the list, both with the pool.
/// churn_erased_array_over_list: for 10,000 particles, an array from whose middle each dead particle is erased.
/// growth_array_over_list: time to grow from nothing to 100,000 particles in 200 steps: an array that doubles its
/// capacity, over a list; growth_moved_array_over_list: an array that is moved completely at each step.
/// bytes_list_over_array: bytes of a particle with its link over those of the particle; …_of_places: of a particle with
/// only a position, a control.
/// scan_twice: an array scanned twice over once, a control.
/// allocation_of_equals, churn_of_equals, growth_of_equals, scan_of_equals: controls, one list and one array of
/// structures measured twice. scan_ns_…, churn_ns_…: nanoseconds per particle and step, by `list`, `aos`, `soa`, with
/// `_pool`.
[[nodiscard]] DUSTBENCH_API ExperimentInfo describe();
[[nodiscard]] std::vector<Finding> measureStorage(std::uint64_t seed, std::size_t particles, int repetitions);

}  // namespace dustbench::particles::storage
