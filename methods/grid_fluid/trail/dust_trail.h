// The dust that has left a fluid's box: tiles of cells, born where dust enters and dropped when almost none is left.
//
// The wind moves all cells as one lattice, which neither loses nor blurs dust, and the dust ages as in the box. Dust
// that enters or leaves is distributed by overlapping volumes, so that no amount is lost and uniform dust stays
// uniform. Units: metres, amounts in m³ (density times volume). Frame: world. Owns: the tiles, booked on an account.
// Threads: one at a time.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::grid_fluid {

/// The shares of lattice cells that an interval covers along one axis, in cells.
/// An interval of at most one cell touches at most two; their shares sum to 1.
struct Overlaps {
    Overlaps(double from, double to) {
        // Shares that are rounding errors would create tiles.
        constexpr double least = 1e-6;
        first = static_cast<int>(std::floor(from));
        const double border = first + 1.0;
        const double length = to - from, before = length > 0 ? std::fmin((border - from) / length, 1.0) : 1.0;
        if (before < least) {
            ++first;
        } else if (before < 1 - least) {
            shares = {before, 1 - before};
            count = 2;
        }
    }

    int first;
    int count = 1;
    std::array<double, 2> shares{1, 0};
};

struct Cuboid {
    glm::dvec3 minimum, maximum;
};

struct TrailSettings {
    double spacingMetres = 0.1;
    glm::vec3 windMetresPerSecond{0};
    float decayPerSecond = 0;
};

class DustTrail {
 public:
    static constexpr int edge = 32;  ///< of a tile, in cells
    static constexpr std::size_t tileCells = std::size_t{edge} * edge * edge;

    struct Tile {
        explicit Tile(MemoryAccount& account) : density(account) { density.resize(tileCells); }

        LedgerVector<float> density;  ///< x fastest, without `share`
        double share = 1;             ///< of the density that has not died of age
        double amountM3 = 0;
        float maximum = 0;          ///< of `density`
        std::uint64_t version = 0;  ///< grows whenever `density` changes
        bool changed = false;       ///< since the last `settle`
        float quietSeconds = 0;     ///< since dust entered
    };
    /// By position, in tiles.
    using Tiles = std::map<std::array<int, 3>, Tile>;

    /// The tile of a cell of the lattice, and its index there.
    [[nodiscard]] static std::array<int, 3> tileOf(const glm::ivec3& cell);
    [[nodiscard]] static std::size_t indexOf(const glm::ivec3& cell, const std::array<int, 3>& tile);

    DustTrail(const TrailSettings& settings, MemoryAccount& account) : settings_(settings), account_(account) {}

    /// Applies wind and age.
    void pass(float seconds);
    /// Spreads an amount evenly over a cuboid of at most a cell's size.
    void add(const Cuboid& where, double amountM3);
    /// Removes the cells that entered `box` since the last call, by their centres. `taker` receives the centre and
    /// amount of each.
    void takeEntered(const Cuboid& box, const std::function<void(const glm::dvec3& middle, double amountM3)>& taker);
    /// Updates the tiles' amounts, and drops tiles with less than `leastM3` whose densities are all less than
    /// `leastDensity`, unless dust is entering them: dust that enters slowly must not be dropped each time.
    void settle(double leastM3 = 0, double leastDensity = 0);

    [[nodiscard]] const Tiles& tiles() const { return tiles_; }
    [[nodiscard]] glm::dvec3 originOf(const std::array<int, 3>& tile) const {
        return driftMetres_ + settings_.spacingMetres * edge * glm::dvec3(tile[0], tile[1], tile[2]);
    }
    /// A world position in lattice coordinates.
    [[nodiscard]] glm::dvec3 inCells(const glm::dvec3& place) const {
        return (place - driftMetres_) / settings_.spacingMetres;
    }
    [[nodiscard]] double spacingMetres() const { return settings_.spacingMetres; }
    /// The amount at the last `settle`.
    [[nodiscard]] double amountM3() const;
    [[nodiscard]] std::uint64_t stateHash() const;

 private:
    struct CellRange {
        glm::ivec3 first{0}, end{0};
        [[nodiscard]] bool contains(const glm::ivec3& cell) const {
            return glm::all(glm::greaterThanEqual(cell, first)) && glm::all(glm::lessThan(cell, end));
        }
    };
    void addTo(const glm::ivec3& cell, double amountM3);

    TrailSettings settings_;
    MemoryAccount& account_;
    Tiles tiles_;
    glm::dvec3 driftMetres_{0};  ///< displacement of the lattice since the beginning
    CellRange inBox_;            ///< cells in the box at the last call of `takeEntered`
};

}  // namespace dustbench::grid_fluid
