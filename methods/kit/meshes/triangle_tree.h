// Triangles in a tree that finds the first one that a segment meets, and the one nearest to a point.
//
// Units: metres. Frame: world. Owns: the tree (Embree's) and a copy of the triangles. Threads: const members are safe
// from any. Embree finds the triangle; where it is met or nearest is computed here in double precision, because
// Embree's own arithmetic differs from processor to processor, and the state must not.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::meshes {

class DUSTBENCH_API TriangleTree {
 public:
    TriangleTree();
    ~TriangleTree();
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;

    /// Call `build` after the last one.
    void add(const scene::Mesh& mesh, const glm::mat4& toWorld);
    /// Throws InputError if Embree fails.
    void build();

    struct Hit {
        float share;       ///< of the way from `from` to `to`
        glm::vec3 normal;  ///< unit, towards `from`
    };
    [[nodiscard]] std::optional<Hit> firstHit(const glm::vec3& from, const glm::vec3& to) const;

    /// The point of a triangle, in the order in which they were added: Σ weights·corner.
    struct Nearest {
        std::size_t triangle;
        glm::dvec3 weights;
        double distanceMetres;
    };
    /// The nearest point within the radius; of equal ones that of the first triangle.
    [[nodiscard]] std::optional<Nearest> nearest(const glm::vec3& point, float radiusMetres) const;

    [[nodiscard]] std::size_t triangles() const { return corners_.size(); }
    /// Of the triangles, and of Embree's tree as Embree counts it.
    [[nodiscard]] std::size_t bytes() const;

 private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
    std::vector<std::array<glm::vec3, 3>> corners_;
};

}  // namespace dustbench::meshes
