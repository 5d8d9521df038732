// Draws a fluid's box and the trail behind it as one cloud, tile by tile.
//
// Each grid is shown with a rim of empty cells. Interpolation is linear in the cells' values, so the rims of neighbours
// add up to what one grid would show: no border is seen. Only light is found by each grid on its own.
// Units: metres. Frame: world. Owns: a picture of each tile. Threads: the OpenGL thread.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/trail/dust_trail.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::grid_fluid {

/// Layers of empty cells around a shown grid. There are none below a floor, where the lowest cells go on.
struct Rim {
    glm::ivec3 before{0}, behind{0};

    Rim() = default;
    Rim(raycast::Filter filter, bool onFloor);
    [[nodiscard]] glm::ivec3 around(const glm::ivec3& cells) const { return cells + before + behind; }
    /// Copies cells, times `share`, into `to`, with their rim.
    void surround(const glm::ivec3& cells, std::span<const float> values, float share, std::vector<float>& to) const;
};

class TrailPicture {
 public:
    /// `ofBox` and `ledger` must outlive it. `onFloor`: the ground is level at y = 0.
    TrailPicture(const raycast::GridRaycast& ofBox, const raycast::RaycastSettings& settings, bool onFloor);

    /// Takes over the tiles that changed.
    void show(const DustTrail& trail);
    /// Draws the tiles and the box, which `ofBox` shows, from far to near.
    void draw(const scene::View& view, const gpu::Layer& layer, raycast::GridRaycast& ofBox, const flow::FluidBox& box);

    [[nodiscard]] std::int64_t primitives() const { return primitives_; }
    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    struct ShownTile {
        std::unique_ptr<raycast::GridRaycast> picture;
        std::uint64_t version = 0;
        double share = 0;  ///< of the tile when it was taken over
        glm::dvec3 middle{0};
    };
    using Place = std::array<int, 3>;
    [[nodiscard]] bool isSeen(const DustTrail::Tile& tile, double spacingMetres) const;
    void showTile(const DustTrail& trail, const Place& place, const DustTrail::Tile& tile);
    [[nodiscard]] Rim rimOf(const Place& place) const;

    const raycast::GridRaycast& ofBox_;
    raycast::RaycastSettings settings_;
    bool onFloor_;
    std::map<Place, ShownTile> tiles_;
    std::vector<float> surrounded_;
    std::int64_t primitives_ = 0;
};

}  // namespace dustbench::grid_fluid
