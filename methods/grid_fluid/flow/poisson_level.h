// One grid of the pressure's hierarchy: Σ w·(pₙ − p) = f over the six faces of each cell, and its smoother.
//
// The finest grid's weights follow from the cells (1 between cells of fluid, 2 at an open side, 0 at solids and walls),
// so it stores only a byte for their sum; p is 0 in solids and ghosts. Coarser grids store a weight for each face.
// Units: h²·∇²q = h·∇·u in metres per second, see projection.h. Threads: rows in blocks.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/split_rows.h"

namespace dustbench::grid_fluid::flow {

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
        /// Gauss-Seidel sweeps: red cells, then black cells, whose steps are scaled by these factors (relaxation.h).
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
