// A field of vectors that changes with time, read from files of one grid each, as `dustbench export` writes them.
//
// Trilinear between the centres of cells, constant from the outermost centres to the grid's faces, none beyond them;
// linear in time, constant before the first and after the last.
// Units: metres, seconds, and the field's own. Frame: the files', which is the world. Threads: const members are safe
// from any.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "methods/kit/volumes/volume_library.h"

namespace dustbench::volumes {

class DUSTBENCH_API VectorSeries {
 public:
    /// Throws InputError where a file cannot be read, has no such field, lies on another grid, or has a time that is
    /// not later than that of the file before.
    VectorSeries(std::span<const std::filesystem::path> files, const std::string& field);
    /// From grids with times; `names` are for messages. Throws InputError likewise.
    VectorSeries(std::vector<VectorGrid> grids, std::span<const std::filesystem::path> names);

    /// The field at one moment; valid as long as the series.
    class DUSTBENCH_API Moment {
     public:
        /// None beyond the grid.
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
    std::vector<VectorGrid> grids_;  ///< all of one place and size, times rise
};

/// The files that a path stands for, which may have `*` in its last part, sorted by name. Throws InputError where there
/// is none.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> matchingFiles(const std::filesystem::path& pattern);

}  // namespace dustbench::volumes
