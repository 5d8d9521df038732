// One grid of the pressure's hierarchy: Σ w·(pₙ − p) = f over the six faces of each cell, and its smoother.
//
// The finest grid's weights follow from the cells (1 between cells of fluid, 2 at an open side, 0 at solids and walls),
// so it stores only a byte for their sum; p is 0 in solids and ghosts. Coarser grids store a weight for each face.
// Units: h²·∇²q = h·∇·u in metres per second, see projection.h. Threads: rows in blocks.
// Source: Yavneh1996 (over-relaxed red-black sweeps in three dimensions). Departs: a factor per sweep, for black cells
// only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

// --- Over-relaxation factors; the same for every backend

/// Before and after each coarse correction.
///
/// A sweep solves red cells, then black cells. Seen from the black cells only, this is a step of Richardson's method:
/// an error wave with Jacobi factor μ is multiplied by 1 − ω(1 − μ²) if the black half-sweep steps ω times as far.
/// Coarse grids handle μ² > 4/9; of the rest, three equal sweeps leave up to (4/9)³ = 0.09, and the three factors here
/// 0.02. Red cells never over-relax, so their previous values have no influence; nor do black cells in the last sweep
/// before a residual is taken, which then vanishes there.
inline constexpr std::array relaxationsBefore{1.6f, 1.0f};
inline constexpr std::array relaxationsAfter{1.2f};

/// Factor on the coarse solution. Restriction and interpolation lose part of the components that are no longer smooth
/// there; a factor above 1 recovers it at the cost of overcorrecting the smoothest ones. Of 1, 1.05, … 1.2, this value
/// leaves the smallest remainder of both.
inline constexpr float overcorrection = 1.1f;

// --- Memory layout: each row is split into its red and its black cells, as on a chess board. All neighbours of a red
// cell are black, so a sweep over one colour is a plain loop over whole vectors. Cell i of row (j, k) has colour
// (i + j + k) mod 2 and index i/2 in its half.

struct SplitLayout {
    explicit SplitLayout(glm::ivec3 cells)
        : nx(cells.x),
          ny(cells.y),
          nz(cells.z),
          half((static_cast<std::size_t>(nx) + 1) / 2),
          row((half + 16) / 16 * 16),
          slab(row * (static_cast<std::size_t>(ny) + 2)) {}

    /// First cell of a row, −1 ≤ j ≤ ny, −1 ≤ k ≤ nz. There is at least one entry between two rows, for the ghosts.
    [[nodiscard]] std::size_t at(int j, int k) const {
        return front + static_cast<std::size_t>(k + 1) * slab + static_cast<std::size_t>(j + 1) * row;
    }
    [[nodiscard]] std::size_t size() const { return front + slab * (static_cast<std::size_t>(nz) + 2); }
    [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz); }
    [[nodiscard]] int rowJ(std::size_t r) const { return static_cast<int>(r % static_cast<std::size_t>(ny)); }
    [[nodiscard]] int rowK(std::size_t r) const { return static_cast<int>(r / static_cast<std::size_t>(ny)); }
    [[nodiscard]] std::size_t cells() const { return rows() * static_cast<std::size_t>(nx); }
    /// Number of rows in a block of work that is worth a thread.
    [[nodiscard]] std::size_t rowsInABlock() const { return (std::size_t{4096} + half * 2 - 1) / (half * 2); }

    static constexpr std::size_t front = 16;
    int nx, ny, nz;
    std::size_t half, row, slab;
};

/// One value for each cell, in its two halves.
struct SplitField {
    float* colour[2];

    /// Cell i of row (j, k), ghosts included. For code where speed does not matter.
    [[nodiscard]] float& cell(const SplitLayout& layout, int i, int j, int k) const {
        return colour[(i + j + k) & 1][static_cast<std::ptrdiff_t>(layout.at(j, k)) + (i >> 1)];
    }
};

/// Allocates parts of borrowed memory; without memory it only counts.
class Arena {
 public:
    Arena() = default;
    explicit Arena(std::span<float> memory) : memory_(memory) {}

    [[nodiscard]] float* take(std::size_t floats) {
        const std::size_t at = used_;
        used_ += (floats + 15) / 16 * 16;
        return memory_.empty() ? nullptr : memory_.subspan(at, floats).data();
    }
    [[nodiscard]] SplitField takeField(const SplitLayout& layout) {
        return {{take(layout.size()), take(layout.size())}};
    }
    [[nodiscard]] std::size_t used() const { return used_; }

 private:
    std::span<float> memory_;
    std::size_t used_ = 0;
};

class PoissonLevel {
 public:
    PoissonLevel(glm::ivec3 cells, bool finest, Arena& arena);

    /// Builds the finest grid from SolidCells::conductance.
    void build(const CellLayout& cells, const std::uint8_t* conductance);
    /// Builds a coarser grid: a face conducts the sum of its finer faces, divided by the distance of its cells'
    /// centres.
    void buildFrom(const PoissonLevel& finer);

    void clearPressure();
    /// The operations of one pass through memory, in this order.
    struct Pass {
        /// Assumes zero pressure, whatever is in memory; at least one sweep must follow.
        bool fromZero = false;
        /// Adds the solution of this level (fillNatural), interpolated and overcorrected, to the black cells. The red
        /// ones follow with the next sweep.
        const PoissonLevel* correction = nullptr;
        /// Gauss-Seidel sweeps: red cells, then black cells, whose steps are scaled by these factors.
        std::span<const float> relaxations;
        /// Sets the right side of this level to the sums of the residuals over each of its cells. Only residuals of red
        /// cells are used: those of black cells vanish after an unrelaxed sweep.
        PoissonLevel* restriction = nullptr;
    };
    /// Returns max |f − Ap| if there is a restriction.
    float smooth(const Pass& pass);
    /// One Jacobi sweep, from `pressure` to `other`.
    void jacobi(const SplitField& other);
    /// Max |f − Ap| over all cells.
    [[nodiscard]] float residual() const;
    /// Copies `pressure` to natural cell order, with ghosts mirrored at walls and sign-reversed at open sides.
    void fillNatural(const std::uint8_t (&openSides)[6]);

    /// On a coarser grid: the weight of the face to the next cell along an axis; index −1 along it is the face before
    /// the first cell.
    [[nodiscard]] float face(int axis, int i, int j, int k) const { return faces_[axis].cell(layout, i, j, k); }

    SplitLayout layout;
    bool finest;
    SplitField pressure, rightSide;

 private:
    /// Index 0 is the ghost before the first cell.
    using FaceRow = std::array<float, 4100>;
    /// Adds the weights of the faces behind the cells of a row; along x also the face before the first cell.
    void readFaces(int axis, int j, int k, FaceRow& row) const;
    /// A row's pressure before a sweep: from memory, zero for it and its neighbours, or zero for itself only.
    enum class Guess { memory, zero, ownZero };
    template <Guess guess, bool relaxed>
    void sweepRow(int colour, int j, int k, const SplitField& target, const SplitField& source,
                  float relaxation = 1) const;
    void sweepRed(bool fromZero, int k);
    void sweepBlack(bool fromZero, float relaxation, int k);
    void clearGhosts();
    void addToBlack(const PoissonLevel& coarse, int k);
    /// Restricts to the coarse slab whose last fine slab is `k`; returns max |f − Ap| over the red cells of its slabs.
    float restrictTo(PoissonLevel& coarse, int k) const;
    template <bool keep>
    float rowResidual(int colour, int j, int k, float* out) const;

    SplitField faces_[3]{};     ///< coarse: weight of the face to the next cell along x, y, z
    SplitField sum_{};          ///< coarse: sum of the six weights
    std::uint8_t* bytes_[2]{};  ///< finest: sum of the six weights
    const std::uint8_t* conductance_ = nullptr;
    CellLayout cells_;
    float* natural_ = nullptr;
};

}  // namespace dustbench::grid_fluid::flow
