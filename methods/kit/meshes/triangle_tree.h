// A tree of triangles that finds the first one on a segment and the nearest one to a point.
//
// Units: metres. Frame: world. Owns: the tree (Embree's) and a copy of the triangles. Threads: const members are safe
// from any. Embree finds the triangle; the exact point is computed here in double precision, because Embree's
// arithmetic differs between processors, and the state must not.
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

    /// The point Σ weights·corner of a triangle; triangles are numbered in the order of their addition.
    struct Nearest {
        std::size_t triangle;
        glm::dvec3 weights;
        double distanceMetres;
    };
    /// The nearest point within the radius; at equal distances, that of the first triangle.
    [[nodiscard]] std::optional<Nearest> nearest(const glm::vec3& point, float radiusMetres) const;

    [[nodiscard]] std::size_t triangles() const { return corners_.size(); }
    /// Bytes of the triangles and of Embree's tree, as counted by Embree.
    [[nodiscard]] std::size_t bytes() const;

 private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
    std::vector<std::array<glm::vec3, 3>> corners_;
};

}  // namespace dustbench::meshes
