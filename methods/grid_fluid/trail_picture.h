// Draws a fluid's box and the trail behind it as one cloud, tile by tile.
//
// Each grid is shown with a rim of empty cells. Interpolation is linear in the cells' values, so the rims of neighbours
// add up to what one grid would show. The wind moves the trail's lattice against the box's, which no rim makes up for:
// within some cells of its border the box fades out, and lends to the tiles what it no longer shows. So no border is
// seen. Light comes to each grid through all others (cloud_shade.h).
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
    /// `ofBox` must outlive it. `onFloor`: the ground is level at y = 0.
    TrailPicture(raycast::GridRaycast& ofBox, const raycast::RaycastSettings& settings, const glm::vec3& toSun,
                 bool onFloor);

    /// Takes over the box and the tiles that changed.
    void show(const DustTrail& trail, const raycast::ShownGrid& box);
    /// Draws tiles and box, from far to near.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::int64_t primitives() const { return primitives_; }
    /// Of the tiles.
    [[nodiscard]] std::size_t gpuBytes() const;

    /// The densities as shown, without rims: of the box, and of the cells that it lends. For tests.
    [[nodiscard]] const std::vector<float>& faded() const { return faded_; }
    [[nodiscard]] const std::map<std::array<int, 3>, std::vector<float>>& lent() const { return lent_; }

 private:
    struct ShownTile {
        std::unique_ptr<raycast::GridRaycast> picture;
        std::uint64_t version = 0;
        double share = 0;   ///< of the tile when it was taken over
        bool lent = false;  ///< and something of the box's was in it
        glm::dvec3 middle{0};
    };
    using Place = std::array<int, 3>;
    void fadeBox(const DustTrail& trail, const raycast::ShownGrid& box);
    [[nodiscard]] bool isSeen(const DustTrail::Tile& tile, double spacingMetres) const;
    [[nodiscard]] bool isLit() const { return settings_.shadowCells > 0; }
    /// Finds `tileNow_` and what it is shown as; false if the tile is shown so already.
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
