// Grids as stored in a file: position and time, the values of a volume or of a vector field, and the conditions for
// grids of one series.
//
// Units and frame: the file's own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::volumes {

/// Values lie at the centres of the cells; x runs fastest, z slowest.
struct GridPlace {
    glm::ivec3 cells{0};
    glm::dvec3 origin{0};  ///< minimum corner of the first cell
    double spacing = 0;    ///< edge of a cell
    std::optional<double> timeSeconds;
    bool sparse = false;  ///< cells outside are zero, not unknown

    [[nodiscard]] std::size_t cellCount() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
               static_cast<std::size_t>(cells.z);
    }
    [[nodiscard]] std::size_t indexOf(const glm::ivec3& cell) const {
        return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(cells.y) +
                static_cast<std::size_t>(cell.y)) *
                   static_cast<std::size_t>(cells.x) +
               static_cast<std::size_t>(cell.x);
    }
};

/// May exceed the range of integers.
[[nodiscard]] inline double cellsOf(const GridPlace& place) {
    return static_cast<double>(place.cells.x) * static_cast<double>(place.cells.y) * static_cast<double>(place.cells.z);
}

/// The first cell of `grid` on the lattice of `lead`. Both must be on the same lattice.
[[nodiscard]] DUSTBENCH_API glm::ivec3 firstCell(const GridPlace& lead, const GridPlace& grid);
/// The box of cells that covers both, on the same lattice.
[[nodiscard]] DUSTBENCH_API GridPlace enclosing(const GridPlace& a, const GridPlace& b);

/// Throws InputError unless `grid`, of the file `name`, continues a series after `before`: later in time, and on the
/// lattice of `first`, whose file is `firstName`; without `anyCells` also with exactly the same cells.
void requireGoesOn(const GridPlace& grid, const std::filesystem::path& name, const GridPlace* before,
                   const std::filesystem::path& beforeName, const GridPlace& first,
                   const std::filesystem::path& firstName, bool anyCells);

/// Calls take(first index within `inner`, first index within `outer`, count) for each row of `inner`, which must be
/// inside of `outer`.
template <typename Take>
void forEachRow(const GridPlace& inner, const GridPlace& outer, const Take& take) {
    const glm::ivec3 first = firstCell(outer, inner);
    for (int z = 0; z < inner.cells.z; ++z)
        for (int y = 0; y < inner.cells.y; ++y)
            take(inner.indexOf({0, y, z}), outer.indexOf(first + glm::ivec3(0, y, z)),
                 static_cast<std::size_t>(inner.cells.x));
}

/// Density on a grid, with further fields of the smoke.
struct VolumeGrid : GridPlace {
    std::vector<float> density;
    std::vector<float> temperature;   ///< empty: none
    std::vector<glm::vec3> velocity;  ///< empty: none
};

struct VectorGrid : GridPlace {
    std::vector<glm::vec3> values;
};

/// Receives a volume value by value while it is read, so that the reader need not store all of it.
class VolumeSink {
 public:
    virtual ~VolumeSink() = default;

    /// Called once, before the fields.
    virtual void begin(const GridPlace& place) = 0;
    /// `density`, `temperature` or `velocity`, in this order. Returns false to skip the field's values.
    virtual bool beginField(std::string_view field) = 0;
    /// The field's next values: cell by cell, x fastest; three per cell for a velocity.
    virtual void take(std::span<const float> numbers) = 0;
};

}  // namespace dustbench::volumes
