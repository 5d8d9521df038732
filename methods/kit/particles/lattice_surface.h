// The surface of a lattice: one sheet if it has one layer, otherwise the six sides of each piece.
//
// A side has vertices of its own, so that edges between sides stay sharp. The normal of a vertex is that of the two
// lines through its neighbours: n = (right − left) × (below − above).
//
// Owns: vertices and triangles. Threads: `follow` by one; const members by any.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/kit/particles/lattice.h"

namespace dustbench::particles {

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
