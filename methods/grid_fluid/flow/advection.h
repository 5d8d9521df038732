// Advects all quantities of a cell and the speeds of its faces: trace back along the path, sample, and correct.
//
// Velocities are stored on the faces that they cross: velocityX of cell (i, j, k) on its face towards −x, and so on. A
// cell's path follows the midpoint rule; that of a face is the mean of the paths of its two cells, also second-order
// accurate. Paths follow the velocity at the beginning of the step or at its middle (VelocityAt). Units: metres per
// second, cells. Threads: rows in blocks; cells are independent. Source: Stam1999, 2.2 (semi-Lagrangian); Selle2008,
// Eq. 4 and 3.2 (MacCormack, clamped to the extrema or reverted). Departs: the forward path is the mirrored backward
// path: x₊ = x₋ + 2Δt·u(x), also second-order accurate, without another sample; if either path leaves the box, the
// first guess is kept; grid-scale oscillation is filtered out of the corrections (evened_corrections.h).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/centre_velocities.h"

namespace dustbench::grid_fluid::flow {

enum class AdvectionScheme { semiLagrangian, macCormack };
/// Treatment of a corrected value outside the extrema of the eight cells around the departure point.
enum class Limit {
    clamp,   ///< use the nearer extremum
    revert,  ///< keep the first guess: cloud edges gain far less density
    none,
};

/// The time of the velocity that paths follow.
enum class VelocityAt {
    begin,   ///< beginning of the step: first-order accurate if the flow changes
    middle,  ///< middle of the step, extrapolated from the beginnings of this one and the last: second-order accurate
};

struct AdvectionRule {
    AdvectionScheme scheme = AdvectionScheme::macCormack;
    Limit limit = Limit::clamp;
    VelocityAt velocityAt = VelocityAt::begin;
};

struct AdvectionStep {
    float cellsPerSpeed = 0;     ///< Δt/h
    glm::vec3 maximumSpeeds{0};  ///< of the flow along each axis; along z it must be an upper bound
    float ahead = 0;             ///< aheadOf, if VelocityAt::middle
};

/// The moving parts of a cell, as bits: its faces towards −x, −y, −z (1, 2, 4), and the quantities at its centre (8).
using Moving = std::uint8_t;
inline constexpr Moving allMoves = 15;

/// Cells by which a path may leave the box and still be corrected: next to a wall, speeds across it are rounding
/// errors.
inline constexpr float pathTolerance = 1.0f / 64;

class Advection {
 public:
    Advection(const CellLayout& layout, MemoryAccount& memory)
        : layout_(layout), window_(memory), centres_(layout, memory) {}

    /// Advects `cells`, with ghosts filled; `spare` is temporary. Quantities that do not move are unchanged.
    void advect(CellField& cells, CellField& spare, const Moving* moving, AdvectionRule rule,
                const AdvectionStep& step);
    /// Moves the data kept between steps by whole cells; new cells get the wind's velocity.
    void scroll(glm::ivec3 by, glm::vec3 wind) { centres_.scroll(by, wind); }

 private:
    struct Stagger;
    struct Pass;
    class Row;
    /// Rows of a slab.
    struct Rows {
        int k, first, end;
    };
    /// Velocities of the window: at the cells' centres, and half-way along their paths.
    enum Kept : std::size_t { centre = 0, halfway = 3, kept = 6 };

    /// Index of a cell of the whole field in a ring of `slabs` slabs.
    [[nodiscard]] std::size_t inRing(std::size_t at, std::size_t slabs) const {
        return at / layout_.slab % slabs * layout_.slab + at % layout_.slab;
    }
    [[nodiscard]] std::size_t inPaths(std::size_t at) const { return inRing(at, heldPaths_); }
    [[nodiscard]] float* guess(std::size_t at) { return window_.data() + inRing(at, heldGuesses_) * lanes; }
    [[nodiscard]] float* velocities(std::size_t array) {
        return window_.data() + CellField::floatsBehind + (lanes * heldGuesses_ + array * heldPaths_) * layout_.slab;
    }
    void hold(const Stagger& stagger);
    void findPaths(const Pass& pass, const Rows& rows);
    void findPathsOfRow(const Pass& pass, int j, int k);
    void predict(const Pass& pass, const Rows& rows);
    void keepFarFaces(const Pass& pass, int j, int k);
    template <Limit limit>
    void findCorrections(const Pass& pass, const Rows& rows);
    void addCorrections(const Pass& pass, const Rows& rows);

    CellLayout layout_;
    LedgerVector<float> window_;  ///< first guesses and velocities of the slabs in progress
    CentreVelocities centres_;    ///< of the slabs that paths can reach
    std::size_t heldGuesses_ = 1, heldPaths_ = 1;
};

}  // namespace dustbench::grid_fluid::flow
