// Draws a fluid's box and the trail behind it as one cloud, tile by tile.
//
// Each grid is drawn with a rim of empty cells. Interpolation is linear in the cells' values, so the rims of neighbours
// add up to the picture of a single grid. The wind moves the trail's lattice relative to the box's, which a rim cannot
// hide. So the box fades out within a few cells of its border and lends the missing density to the tiles, and no border
// is visible. Light reaches each grid through all others (CloudShade).
// Units: metres. Frame: world. Owns: a picture of each tile. Threads: the OpenGL thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <vector>

#include "methods/grid_fluid/trail/dust_trail.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::grid_fluid {

/// Sunlight that reaches a point in a cloud of several grids, through all of them but one.
///
/// Each grid is stored as means over blocks of cells, which it owns; a ray to the sun takes steps of one block. In
/// metres of the world, extinction per metre. `arrivingAt` may be called from several threads.
class CloudShade {
 public:
    static constexpr int block = 4;  ///< cells

    /// `toSun`: unit vector.
    CloudShade(const glm::vec3& toSun, double extinctionPerMetre) : toSun_(toSun), extinction_(extinctionPerMetre) {}

    /// Identifies a grid.
    using Id = std::array<int, 3>;

    /// Adds or replaces a grid. All have the same spacing.
    void set(const Id& id, const raycast::ShownGrid& grid);
    /// Moves a grid and sets the remaining share of its original density.
    void change(const Id& id, const glm::dvec3& originMetres, double share);
    void remove(const Id& id) { grids_.erase(id); }
    /// Share of the sunlight that passes all grids but this one.
    [[nodiscard]] float arrivingAt(const glm::dvec3& place, const Id& without) const;

 private:
    struct Blocks {
        glm::dvec3 minimum;
        glm::ivec3 count;
        std::vector<float> mean;
        double share = 1;
    };
    glm::dvec3 toSun_;
    double extinction_, blockMetres_ = 0;
    std::map<Id, Blocks> grids_;
};

class TrailPicture {
 public:
    /// `ofBox` must outlive this. `onFloor`: the ground is level at y = 0.
    TrailPicture(raycast::GridRaycast& ofBox, const raycast::RaycastSettings& settings, const glm::vec3& toSun,
                 bool onFloor);

    /// Uploads the box and the changed tiles.
    void show(const DustTrail& trail, const raycast::ShownGrid& box);
    /// Draws tiles and box, from far to near.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::int64_t primitives() const { return primitives_; }
    /// Memory of the tiles on the GPU.
    [[nodiscard]] std::size_t gpuBytes() const;

    /// The displayed densities without rims: those of the box, and those lent to tiles. For tests.
    [[nodiscard]] const std::vector<float>& faded() const { return faded_; }
    [[nodiscard]] const std::map<std::array<int, 3>, std::vector<float>>& lent() const { return lent_; }

 private:
    struct ShownTile {
        std::unique_ptr<raycast::GridRaycast> picture;
        std::uint64_t version = 0;
        double share = 0;   ///< share of the tile at its upload
        bool lent = false;  ///< it contained density lent by the box
        glm::dvec3 middle{0};
    };
    using Place = std::array<int, 3>;
    void fadeBox(const DustTrail& trail, const raycast::ShownGrid& box);
    [[nodiscard]] bool isSeen(const DustTrail::Tile& tile, double spacingMetres) const;
    [[nodiscard]] bool isLit() const { return settings_.shadowCells > 0; }
    /// Computes `tileNow_` and its displayed grid; returns false if the tile is displayed like that already.
    bool find(const DustTrail& trail, const Place& place, const DustTrail::Tile* tile, raycast::ShownGrid& grid);
    void upload(raycast::GridRaycast& picture, const Place& id, const raycast::ShownGrid& grid);
    void uploadTile(const Place& place, const DustTrail::Tile* tile, const raycast::ShownGrid& grid);

    raycast::GridRaycast& ofBox_;
    raycast::RaycastSettings settings_;
    bool onFloor_;
    CloudShade shade_;
    glm::dvec3 boxMiddle_{0}, boxHalf_{0};  ///< metres
    std::vector<float> faded_, surrounded_, surroundedReaction_, tileNow_, surroundedTile_;
    std::map<Place, std::vector<float>> lent_;
    std::map<Place, ShownTile> tiles_;
    std::int64_t primitives_ = 0;
};

}  // namespace dustbench::grid_fluid
