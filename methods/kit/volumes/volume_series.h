// A volume that changes with time, read from files of one grid each: its density between the first and the last moment.
//
// Between two moments every value changes evenly; beyond a file's cells there is none. Times count from the first
// moment. Units: m, s; density and temperature are the files'. Frame: world (+Y up). Threads: const members are safe
// from any.
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
    /// Notes the files as inputs. Throws InputError, one line with the file.
    static VolumeSeries read(const VolumeSetup& setup);
    /// One moment or more, in the world; `names` are for messages. Throws InputError if times are missing or do not
    /// ascend, or the grids do not lie on one lattice.
    VolumeSeries(std::vector<VolumeGrid> moments, std::vector<std::filesystem::path> names,
                 std::optional<double> secondsPerFile = {});

    /// One moment alone stands still and lasts.
    [[nodiscard]] bool isStill() const { return series_.isStill(); }
    /// From the first moment to the last.
    [[nodiscard]] double seconds() const { return series_.seconds(); }
    [[nodiscard]] std::span<const VolumeGrid> moments() const { return moments_; }
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return names_; }
    [[nodiscard]] std::size_t bytes() const;

    /// The volume so many seconds after the first moment; before it the first, after the end the last. It is one of the
    /// moments, or `between`, which is filled with density and temperature, and with velocity if it is wanted.
    [[nodiscard]] const VolumeGrid& at(double seconds, bool wantsVelocity, VolumeGrid& between) const;

 private:
    std::vector<VolumeGrid> moments_;
    std::vector<std::filesystem::path> names_;
    SeriesPlaces series_;
};

/// Turns a file's grid to +Y up, and places it in the world.
void placeInWorld(VolumeGrid& grid, const VolumeSetup& setup);

}  // namespace dustbench::volumes
