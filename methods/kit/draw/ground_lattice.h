// The ground's triangles round the eye: rings of square cells, each ring twice as coarse as the one inside it, out to
// the horizon.
//
// Units: metres. Frame: world for what goes in; vertices are relative to anchor(), a lattice point near the eye, so
// that floats stay precise however far from the world's origin. Threads: one at a time.
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

/// A rectangle of the ground seen from above: x and z.
struct GroundRectangle {
    glm::dvec2 minimum;
    glm::dvec2 maximum;
};

class GroundLattice {
 public:
    /// `terrain` must outlive the lattice.
    explicit GroundLattice(const scene::Terrain& terrain);

    /// Centres the rings on the eye. True where vertices and indices are new.
    bool moveTo(const glm::dvec3& eye);

    [[nodiscard]] const glm::dvec3& anchor() const { return anchor_; }
    [[nodiscard]] std::span<const GroundVertex> vertices() const { return vertices_; }
    /// More indices than this are never appended at once.
    [[nodiscard]] std::size_t maximumIndices() const {
        return static_cast<std::size_t>(levels_ * across_ * across_) * 6;
    }

    /// Triangles that may be seen, the finest first. `anchorToClip` has a reversed infinite depth range.
    void appendVisible(const glm::mat4& anchorToClip, std::vector<std::uint32_t>& indices) const;
    /// Triangles whose bounds touch any of the rectangles, each of them once.
    void appendWithin(std::span<const GroundRectangle> rectangles, std::vector<std::uint32_t>& indices) const;

 private:
    /// A square of cells that is kept or left out as one.
    struct Block {
        glm::vec3 minimum, maximum;
        std::size_t firstIndex, lastIndex;
    };
    /// Least corner of one ring, in finest cells.
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
