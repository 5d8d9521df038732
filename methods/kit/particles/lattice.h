// A lattice of particles: columns × rows × layers points per piece, each known by its serial number; the links between
// neighbours, and the surface.
//
// Particles are numbered along columns, then rows, then layers, then pieces. Parts that link neighbours or draw a
// surface find them by number, wherever the particles have moved and in whatever order they are stored.
//
// Units: m. Frame: world, or the vehicle's if it carries the lattice. Owns: links, vertices and triangles. Threads:
// `follow` by one; const members by any. Source: Thesis, 5.4.1 (springs between adjacent particles); Provot1995, 2
// (structural, shear and flexion springs).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/parameters.h"
#include "methods/contract/scene.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::particles {

struct Lattice {
    glm::ivec3 points{1};                    ///< columns, rows, layers
    glm::dvec3 place{0};                     ///< of the first point
    glm::dvec3 column{0}, row{0}, layer{0};  ///< from a point to the next one
    glm::dvec3 piece{0};                     ///< from a piece to the next one
    bool onVehicle = false;

    static void declare(ParameterSet& set);
    /// Throws InputError if two neighbours would be at the same place.
    static Lattice from(const ParameterValues& values);

    /// Points of a piece.
    [[nodiscard]] std::uint64_t size() const {
        return static_cast<std::uint64_t>(points.x) * static_cast<std::uint64_t>(points.y) *
               static_cast<std::uint64_t>(points.z);
    }
    /// Column, row and layer of a particle within its piece.
    [[nodiscard]] glm::ivec3 nodeOf(std::uint64_t serial) const {
        const auto within = static_cast<int>(serial % size());
        return {within % points.x, within / points.x % points.y, within / (points.x * points.y)};
    }
    /// Position at rest, in the frame of the lattice.
    [[nodiscard]] glm::dvec3 restOf(std::uint64_t serial) const {
        const glm::dvec3 node(nodeOf(serial));
        const auto repeat = serial / size();
        return place + node.x * column + node.y * row + node.z * layer + static_cast<double>(repeat) * piece;
    }
    /// From the frame of the lattice to the world at the end of the step.
    [[nodiscard]] glm::dmat4 toWorld(const scene::SceneState& state) const {
        return onVehicle ? state.vehicle.toWorld() : glm::dmat4(1);
    }
};

// --- Links: edges, diagonals, and links across one point, which resist bending.

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

/// Links are ordered by colour: no two links of a colour share a particle, so that all links of a colour may be
/// processed at the same time with the same result in any order. Colours follow from the lattice: links along one
/// offset alternate.
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

/// The surface: one sheet if the lattice has one layer, otherwise the six sides of each piece. A side has vertices of
/// its own, so that edges between sides stay sharp. The normal of a vertex is that of the two lines through its
/// neighbours: n = (right − left) × (below − above).
class DUSTBENCH_API LatticeSurface {
 public:
    /// Indices of particles in the store; a missing neighbour is the particle itself.
    struct Vertex {
        std::uint32_t particle, left, right, above, below;
        glm::ivec2 node;  ///< column and row within its side
    };

    /// Builds the surface of the living particles. Returns false if they are those of the last call.
    bool follow(const Lattice& lattice, std::span<const std::uint64_t> serials);

    [[nodiscard]] std::span<const Vertex> vertices() const { return vertices_; }
    /// Three vertices per triangle, counter-clockwise seen from outside.
    [[nodiscard]] std::span<const std::uint32_t> triangles() const { return triangles_; }
    [[nodiscard]] std::size_t bytes() const;

    /// Unit normal of a vertex, where `positionOf(i)` is the position of particle `i`; zero where the surface is folded
    /// to a line.
    template <typename PositionOf>
    [[nodiscard]] static glm::vec3 normalOf(const Vertex& v, const PositionOf& positionOf) {
        const glm::vec3 n =
            glm::cross(positionOf(v.right) - positionOf(v.left), positionOf(v.below) - positionOf(v.above));
        const float length = glm::length(n);
        return length > 0 ? n / length : glm::vec3(0);
    }

 private:
    struct Side;
    void addSide(const Side& side, const Lattice& lattice, std::span<const std::uint32_t> particleOf);

    std::vector<std::uint64_t> serials_;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace dustbench::particles
