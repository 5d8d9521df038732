// A volume that changes with time, read from files of one grid each, and the moments of such a series.
//
// Values change linearly between two moments and are zero outside of a file's cells. Times count from the first moment.
// Units: m, s; density and temperature as in the files. Frame: world (+Y up). Threads: const members are safe from any.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
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

/// Position and time of each moment, and which of them are shown at a given time.
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

class DUSTBENCH_API VolumeSeries {
 public:
    /// Notes the files as inputs. Throws InputError with the file in one line.
    static VolumeSeries read(const VolumeSetup& setup);
    /// At least one moment, in the world; `names` are for messages. Throws InputError if times are missing or do not
    /// ascend, or the grids are not on one lattice.
    VolumeSeries(std::vector<VolumeGrid> moments, std::vector<std::filesystem::path> names,
                 std::optional<double> secondsPerFile = {});

    /// A single moment does not change and has no end.
    [[nodiscard]] bool isStill() const { return series_.isStill(); }
    /// From the first moment to the last.
    [[nodiscard]] double seconds() const { return series_.seconds(); }
    [[nodiscard]] std::span<const VolumeGrid> moments() const { return moments_; }
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return names_; }
    [[nodiscard]] std::size_t bytes() const;

    /// The volume at a time in seconds after the first moment; before it the first one, after the end the last one.
    /// Returns a moment or `between`, filled with density and temperature, and with velocity if `wantsVelocity`.
    [[nodiscard]] const VolumeGrid& at(double seconds, bool wantsVelocity, VolumeGrid& between) const;

 private:
    std::vector<VolumeGrid> moments_;
    std::vector<std::filesystem::path> names_;
    SeriesPlaces series_;
};

/// Rotates a file's grid to +Y up and places it in the world.
void placeInWorld(VolumeGrid& grid, const VolumeSetup& setup);

}  // namespace dustbench::volumes
