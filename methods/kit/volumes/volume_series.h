// A volume that changes with time, read from files of one grid each.
//
// Values change linearly between two moments and are zero outside of a file's cells. Times count from the first moment.
// Units: m, s; density and temperature as in the files. Frame: world (+Y up). Threads: const members are safe from any.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "methods/kit/volumes/series_places.h"
#include "methods/kit/volumes/volume_grid.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

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
