// Draws a fluid's box and the trail behind it as one cloud, tile by tile.
//
// Each grid is drawn with a rim of empty cells. Interpolation is linear in the cells' values, so the rims of neighbours
// add up to the picture of a single grid. The wind moves the trail's lattice relative to the box's, which a rim cannot
// hide. So the box fades out within a few cells of its border and lends the missing density to the tiles, and no border
// is visible. Light reaches each grid through all others (cloud_shade.h).
// Units: metres. Frame: world. Owns: a picture of each tile. Threads: the OpenGL thread.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "methods/grid_fluid/cloud_shade.h"
#include "methods/grid_fluid/trail/dust_trail.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::grid_fluid {

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
