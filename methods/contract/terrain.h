// The ground: a plane, or a height field on a regular grid.
//
// Units: metres. Frame: world, +Y up.
// Threads: const members may be called from any thread.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace dustbench::scene {

class DUSTBENCH_API Terrain {
 public:
    /// The plane y = 0.
    Terrain() = default;
    /// `heights[j * columns + i]` is the height at world (originX + i·spacing, originZ + j·spacing). Heights are
    /// bilinear in between and clamped to the edge outside. Throws std::invalid_argument unless columns and rows are 2
    /// or more, there are columns·rows heights and the spacing is positive.
    Terrain(std::vector<float> heights, int columns, int rows, float spacingMetres, float originX, float originZ);

    [[nodiscard]] bool isFlat() const { return heights_.empty(); }
    [[nodiscard]] float heightAt(float x, float z) const;
    /// Unit normal of the bilinear surface.
    [[nodiscard]] glm::vec3 normalAt(float x, float z) const;

    [[nodiscard]] const std::vector<float>& heights() const { return heights_; }
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] float spacingMetres() const { return spacing_; }
    [[nodiscard]] glm::vec2 origin() const { return origin_; }  ///< (x, z) of the first height

 private:
    std::vector<float> heights_;
    int columns_ = 0;
    int rows_ = 0;
    float spacing_ = 1;
    glm::vec2 origin_{0};
};

}  // namespace dustbench::scene
