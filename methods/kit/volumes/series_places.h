// The moments of a series of volumes: position and time of each, and which of them are shown at a given time.
//
// Values change linearly between two moments. Times count from the first moment. Units: m, s. Frame: world.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "methods/kit/volumes/grid_place.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

/// A time within this distance of a moment counts as that moment, because files round their times.
inline constexpr double sameMomentSeconds = 1e-5;

/// The moments before and after a time, and the share of the later one; 0: the earlier one alone.
struct Between {
    std::size_t before = 0, after = 0;
    float share = 0;
};

class DUSTBENCH_API SeriesPlaces {
 public:
    /// At least one moment, in the world; `names` are for messages. If none has a time, they follow each other by
    /// `secondsPerFile`. Throws InputError if times are missing or do not ascend, the grids are not on one lattice, or
    /// two consecutive ones cover more than `maximumCells` together.
    SeriesPlaces(std::vector<GridPlace> places, const std::vector<std::filesystem::path>& names,
                 std::optional<double> secondsPerFile, std::int64_t maximumCells);

    [[nodiscard]] const std::vector<GridPlace>& places() const { return places_; }
    /// A single moment does not change and has no end.
    [[nodiscard]] bool isStill() const { return places_.size() == 1; }
    /// From the first moment to the last.
    [[nodiscard]] double seconds() const;
    /// At a time in seconds after the first moment; before it the first one, after the end the last one.
    [[nodiscard]] Between at(double seconds) const;

 private:
    std::vector<GridPlace> places_;
};

/// Rotates a file's grid to +Y up and places it in the world: the position of its cells, not its values.
[[nodiscard]] DUSTBENCH_API GridPlace placedInWorld(const GridPlace& place, const VolumeSetup& setup);

}  // namespace dustbench::volumes
