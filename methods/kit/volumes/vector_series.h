// A time-dependent vector field, read from files of one grid each as written by `dustbench export`.
//
// Trilinear between cell centres, constant from the outermost centres to the grid's faces, undefined outside; linear in
// time, constant before the first and after the last file.
// Units: metres, seconds, and the field's own. Frame: the files', which is the world. Threads: const members are safe
// from any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "methods/kit/volumes/grid_place.h"

namespace dustbench::volumes {

class DUSTBENCH_API VectorSeries {
 public:
    /// Throws InputError if a file cannot be read, has no such field, has a different grid, or has a time that is not
    /// later than that of the previous file.
    VectorSeries(std::span<const std::filesystem::path> files, const std::string& field);
    /// Takes grids with times; `names` are for messages. Throws InputError likewise.
    VectorSeries(std::vector<VectorGrid> grids, std::span<const std::filesystem::path> names);

    /// The field at one time; valid as long as the series.
    class DUSTBENCH_API Moment {
     public:
        /// Returns the field at a point; empty outside the grid.
        [[nodiscard]] std::optional<glm::vec3> at(const glm::dvec3& point) const;

     private:
        friend class VectorSeries;
        const VectorGrid* before_ = nullptr;
        const VectorGrid* after_ = nullptr;
        float share_ = 0;  ///< of `after_`
    };
    [[nodiscard]] Moment momentAt(double timeSeconds) const;

    [[nodiscard]] double firstSeconds() const { return *grids_.front().timeSeconds; }
    [[nodiscard]] double lastSeconds() const { return *grids_.back().timeSeconds; }
    [[nodiscard]] std::size_t bytes() const;

 private:
    std::vector<VectorGrid> grids_;  ///< same position and size, ascending times
};

}  // namespace dustbench::volumes
