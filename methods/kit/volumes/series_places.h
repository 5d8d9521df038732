// The moments of a series of volumes: where each lies and when, and which are shown at a time.
//
// Between two moments every value changes evenly. Times count from the first moment. Units: m, s. Frame: world.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "methods/kit/volumes/grid_place.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

/// A time that misses a moment by less is that moment: files round their times.
inline constexpr double sameMomentSeconds = 1e-5;

/// The moments before and after a time, and the share of the one after; 0: the one before, alone.
struct Between {
    std::size_t before = 0, after = 0;
    float share = 0;
};

class DUSTBENCH_API SeriesPlaces {
 public:
    /// One moment or more, in the world; `names` are for messages. Where none has a time they follow each other by
    /// `secondsPerFile`. Throws InputError if times are missing or do not ascend, the grids do not lie on one lattice,
    /// or two that follow each other cover more than `maximumCells` together.
    SeriesPlaces(std::vector<GridPlace> places, const std::vector<std::filesystem::path>& names,
                 std::optional<double> secondsPerFile, std::int64_t maximumCells);

    [[nodiscard]] const std::vector<GridPlace>& places() const { return places_; }
    /// One moment alone stands still and lasts.
    [[nodiscard]] bool isStill() const { return places_.size() == 1; }
    /// From the first moment to the last.
    [[nodiscard]] double seconds() const;
    /// So many seconds after the first moment; before it the first, after the end the last.
    [[nodiscard]] Between at(double seconds) const;

 private:
    std::vector<GridPlace> places_;
};

/// Turns a file's grid to +Y up, and places it in the world: where its cells lie, not its values.
[[nodiscard]] DUSTBENCH_API GridPlace placedInWorld(const GridPlace& place, const VolumeSetup& setup);

}  // namespace dustbench::volumes
