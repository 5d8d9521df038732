// Compares a fire shown as a volume with the same fire shown as particles, and does the same for single pieces (claim
// R34).
//
// A fire burns in a box. It is shown with parallel rays as a volume by its transfer function, and as particles. These
// are born in the source with its freshness, carried by the air, and coloured by the same function as they age. Both
// use the same coarse grid. There are two references, with a flow in a grid of half the spacing. `by_paths` is neither
// volume nor particles: it follows the path of the air at a place back to the beginning of the fire and adds the
// source's emission along it, so that nothing is stored in cells or particles. `by_volume` is a volume in the finer
// grid, with an equally fine march. Pieces are separate puffs in the same box, shown as particles and as densities of
// the grid's cells.
//
// Units: metres, seconds; linear RGB. Threads: the current oneTBB arena; results do not depend on their number.
// Source: Senger2009, ch. 5.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/grid_fluid/fire_pictures.h"

namespace dustbench::grid_fluid::fire {

struct Burning {
    FireGrid grid;
    std::vector<Flake> particles;  ///< not yet given a width: deviation 0, depth τ·2π·s²
    FireField field;               ///< by the paths of the air; empty unless requested
};

enum class Paths { forgotten, kept };

/// A fire after `seconds`, its source placed by `seed`, in a box of `cells` × 2 `cells` × `cells`.
[[nodiscard]] Burning burn(int cells, double seconds, int particles, std::uint64_t seed,
                           Paths paths = Paths::forgotten);

/// `count` pieces of one width, away from the sides, drawn by `seed`; and their mass in the cells of a grid.
[[nodiscard]] std::vector<Flake> scatter(int count, double deviation, std::uint64_t seed);
[[nodiscard]] FireGrid gridOf(const std::vector<Flake>& pieces, int cells);

/// The experiment `fire`, of fires and pieces drawn by the seed:
///     error_ratio_REFERENCE        geometric mean: the volume's distance from the reference, divided by that of the
///                                  particles
///     correlation_lead_REFERENCE   mean: rank correlation of the volume minus that of the particles
///     error_ratio_video_REFERENCE  geometric mean: the volume's distance from the reference, divided by that of a
///                                  video texture: the nearest of three other fires, whose sources have another size
///                                  and heat, recorded as finely as the reference and shown at the same place
///     error_ratio_video_over_particles_REFERENCE
///                                  geometric mean: the same video texture's distance, divided by that of the particles
///     references_apart             geometric mean: distance of the two references from each other
///     pieces_lead                  mean: share of pieces visible as particles minus the share visible as a volume
/// and the controls, which must reverse these:
///     control_error_ratio_REFERENCE, control_correlation_lead_REFERENCE
///                                  with the transfer function reversed for the volume
///     control_error_ratio_video_by_paths
///                                  with a video of this very fire; error_ratio_own_video_over_particles_by_paths:
///                                  the distance of that video, divided by that of the particles
///     control_pieces_lead          with pieces that a grid can resolve, two cells wide
/// REFERENCE: by_paths, by_volume. Of three widths of particles, the one with the smallest error counts.
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::fire
