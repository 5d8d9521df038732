// The ground's triangles around the eye: nested rings of square cells, each ring twice as coarse as the one inside it,
// out to the horizon.
//
// Units: metres. Frame: inputs in the world; vertices are relative to anchor(), a lattice point near the eye, so that
// floats stay precise far from the world's origin. Threads: one at a time.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/terrain.h"

namespace dustbench::draw {

struct GroundVertex {
    glm::vec3 position;
    glm::vec3 normal;
};

/// An axis-aligned rectangle of the ground in x and z.
struct GroundRectangle {
    glm::dvec2 minimum;
    glm::dvec2 maximum;
};

class GroundLattice {
 public:
    /// `terrain` must outlive the lattice.
    explicit GroundLattice(const scene::Terrain& terrain);

    /// Centres the rings on the eye. Returns true if vertices and indices have changed.
    bool moveTo(const glm::dvec3& eye);

    [[nodiscard]] const glm::dvec3& anchor() const { return anchor_; }
    [[nodiscard]] std::span<const GroundVertex> vertices() const { return vertices_; }
    /// Upper bound on the number of indices that one call appends.
    [[nodiscard]] std::size_t maximumIndices() const {
        return static_cast<std::size_t>(levels_ * across_ * across_) * 6;
    }

    /// Appends the triangles that may be visible, finest first. `anchorToClip` has a reversed infinite depth range.
    void appendVisible(const glm::mat4& anchorToClip, std::vector<std::uint32_t>& indices) const;
    /// Appends the triangles whose bounds touch any of the rectangles, each triangle once.
    void appendWithin(std::span<const GroundRectangle> rectangles, std::vector<std::uint32_t>& indices) const;

 private:
    /// A square of cells that is culled as a unit.
    struct Block {
        glm::vec3 minimum, maximum;
        std::size_t firstIndex, lastIndex;
    };
    /// Minimum corner of a ring, in finest cells.
    struct Corner {
        std::int64_t x, z;
    };

    [[nodiscard]] std::int64_t stride(int level) const { return std::int64_t{1} << level; }
    [[nodiscard]] std::int64_t centreOf(int level, double coordinate, double origin) const;
    [[nodiscard]] glm::vec3 normalAt(double x, double z, double step) const;
    [[nodiscard]] std::uint32_t vertexOf(int level, int i, int j) const;
    void makeVertices(int level);
    void makeBlock(int level, int firstColumn, int firstRow);

    const scene::Terrain& terrain_;
    double cellMetres_ = 1;
    int across_ = 8;  ///< cells along the side of a ring
    int levels_ = 1;
    glm::dvec3 anchor_{0};
    std::int64_t anchorX_ = 0;
    std::int64_t anchorZ_ = 0;
    std::vector<Corner> corners_;
    std::vector<GroundVertex> vertices_;
    std::vector<std::uint32_t> indices_;
    std::vector<Block> blocks_;
};

}  // namespace dustbench::draw
