// The springs of a lattice: edges, diagonals, and links across one point, which resist bending.
//
// Links are ordered by colour: no two links of a colour share a particle, so that all links of a colour may be
// processed at the same time with the same result in any order. Colours follow from the lattice: links along one offset
// alternate.
//
// Units: m. Owns: its links. Threads: `follow` by one; const members by any.
// Source: Provot1995, 2 (structural, shear and flexion springs).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/lattice.h"

namespace dustbench::particles {

struct Link {
    std::uint32_t a, b;  ///< indices in the store
    float restMetres;
    float share;  ///< of the stiffness of an edge
};

/// Stiffness of diagonals and of links across one point, as shares of that of edges; 0: none.
struct LinkShares {
    float diagonals = 0.5f, bending = 0.1f;
};

/// Points that do not move relative to the lattice's frame.
enum class Pins { none, corners, row, column, end };
inline constexpr Choices<Pins> pinWords{
    {"none", Pins::none}, {"corners", Pins::corners}, {"row", Pins::row}, {"column", Pins::column}, {"end", Pins::end}};
inline constexpr const char* pinHelp =
    "points that stay in their places in the lattice's frame: none; the two corners of the first row; the first row; "
    "the "
    "first column; the first point (end)";

[[nodiscard]] bool isPinned(Pins pins, const Lattice& lattice, const glm::ivec3& node);

class LatticeLinks {
 public:
    /// Links the living particles; does nothing if they are those of the last call.
    void follow(const Lattice& lattice, Pins pins, const LinkShares& shares, std::span<const std::uint64_t> serials);

    [[nodiscard]] std::span<const Link> links() const { return links_; }
    [[nodiscard]] std::size_t colours() const { return colourBegin_.empty() ? 0 : colourBegin_.size() - 1; }
    [[nodiscard]] std::span<const Link> ofColour(std::size_t c) const {
        return links().subspan(colourBegin_[c], colourBegin_[c + 1] - colourBegin_[c]);
    }
    /// Indices of pinned particles in the store.
    [[nodiscard]] std::span<const std::uint32_t> pinned() const { return pinned_; }
    /// Bound on the eigenvalues of the matrix of links, where an edge counts 1: for springs of stiffness k between
    /// masses m, ω² ≤ k·λ/m. By Gershgorin's theorem, λ = max_i (Σ_j s_ij + Σ_{j free} s_ij).
    [[nodiscard]] double eigenvalueBound() const { return eigenvalueBound_; }
    [[nodiscard]] std::size_t bytes() const;

    /// Calls `work(link)` for every link, colour by colour, with the links of a colour shared by threads.
    template <typename Work>
    void forEach(const Work& work) const {
        for (std::size_t c = 0; c < colours(); ++c)
            parallel::forEachBlock(ofColour(c).size(), 1024, [&](std::size_t first, std::size_t count) {
                for (const Link& link : ofColour(c).subspan(first, count)) work(link);
            });
    }

 private:
    void linkAll(const Lattice& lattice, const LinkShares& shares);
    void linkAlong(const Lattice& lattice, const glm::ivec3& offset, float share);
    void bound(std::size_t particles);

    std::vector<std::uint64_t> serials_;  ///< of the last call, in storage order
    std::vector<std::uint32_t> order_;    ///< storage indices by serial
    std::vector<Link> links_;
    std::vector<std::size_t> colourBegin_;
    std::vector<std::uint32_t> pinned_;
    double eigenvalueBound_ = 0;
};

}  // namespace dustbench::particles
