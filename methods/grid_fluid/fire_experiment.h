// Holds a fire shown as a volume against the same fire shown as particles, and single pieces likewise (claim R34).
//
// A fire burns in a box. It is shown, in parallel rays, as a volume by its transfer function, and as particles: born in
// the source, as fresh as it is there, carried by the air, coloured through the same function as they age. Both belong
// to the same coarse grid. There are two references, of a flow in a grid of half the spacing. `by_paths` is of neither
// kind: the path of the air at a place is followed back to the fire's beginning, and the source adds what it gave on
// the way, so that nothing is kept in cells or in particles. `by_volume` is a volume in the finer grid, with a march as
// fine. Pieces are puffs that lie apart in the same box, as particles and as densities of the grid's cells.
//
// Units: metres, seconds; linear RGB. Threads: the current oneTBB arena; the same at any number of them.
// Source: Senger2009, ch. 5.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/grid_fluid/fire_pictures.h"

namespace dustbench::grid_fluid::fire {

struct Burning {
    FireGrid grid;
    std::vector<Flake> particles;  ///< `particles` of them, without a width yet: a deviation of 0, a depth of τ·2π·s²
    FireField field;               ///< by the paths of the air; empty unless asked for
};

enum class Paths { forgotten, kept };

/// A fire after `seconds`, its source placed by `seed`, in a box of `cells` × 2 `cells` × `cells`.
[[nodiscard]] Burning burn(int cells, double seconds, int particles, std::uint64_t seed,
                           Paths paths = Paths::forgotten);

/// `count` pieces of a width, nowhere near the sides, drawn by `seed`; and their mass in the cells of a grid.
[[nodiscard]] std::vector<Flake> scatter(int count, double deviation, std::uint64_t seed);
[[nodiscard]] FireGrid gridOf(const std::vector<Flake>& pieces, int cells);

/// The experiment `fire`, of fires and pieces drawn by the seed:
///     error_ratio_REFERENCE        geometric mean: distance of the volume to that of the particles, each from the
///                                  reference
///     correlation_lead_REFERENCE   mean: rank correlation of the volume less that of the particles
///     references_apart             geometric mean: distance of the two references from each other
///     pieces_lead                  mean: share of pieces seen as particles less that seen as a volume
/// and with what must turn these round:
///     control_error_ratio_REFERENCE, control_correlation_lead_REFERENCE
///                                  the transfer function read backwards by the volume
///     control_pieces_lead          pieces that a grid can hold, two cells wide
/// REFERENCE: by_paths, by_volume. Of three widths of particles the one with the least error counts.
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::fire
