// Ray casting on the CPU: sixteen neighbouring pixels at a time, in parallel.
//
// Takes the same steps as grid_march.frag. Units: cells. Owns: the grid in its own layout. Threads: march() uses the
// current oneTBB arena; the picture does not depend on the number of threads. Source: Senger2009, ch. 4.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/kit/raycast/brick_map.h"
#include "methods/kit/raycast/light_volume.h"
#include "methods/kit/raycast/padded_cells.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

/// A rectangle of pixels in packets of 4×4, row by row from the bottom left. For each of the `channels`, the sixteen
/// floats of a packet are contiguous: alpha, or red, green, blue and alpha, premultiplied.
struct PacketPicture {
    static constexpr int edge = 4, pixels = edge * edge;

    PixelRectangle rectangle;
    int channels = 1;
    std::span<float> values;

    [[nodiscard]] int packetsAcross() const { return (rectangle.width() + edge - 1) / edge; }
    [[nodiscard]] std::size_t packets() const {
        return static_cast<std::size_t>(packetsAcross()) *
               static_cast<std::size_t>((rectangle.height() + edge - 1) / edge);
    }
    [[nodiscard]] std::size_t floats() const { return packets() * pixels * static_cast<std::size_t>(channels); }
};

/// The opaque scene's depths, row by row from the bottom.
struct SceneDepths {
    std::span<const float> values;
    int width = 0, height = 0;
};

class CpuMarch {
 public:
    CpuMarch(const RaycastSettings& settings, MemoryLedger& ledger);

    /// `bricks`, and `light` if the cloud casts a shadow on itself, must outlive all marches through this grid.
    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light);

    /// 1 for smoke of uniform colour, else 4.
    [[nodiscard]] int channels() const { return burning_ || light_ ? 4 : 1; }
    /// `picture.channels` must equal `channels()`; `thickness`: share of the extinction of the densities.
    void march(const PixelRays& rays, const SceneDepths& depths, const Reflected& reflected,
               const PacketPicture& picture, float thickness = 1) const;

 private:
    RaycastSettings settings_;
    std::vector<glm::vec4> fire_;
    PaddedCells density_, reaction_;
    const BrickMap* bricks_ = nullptr;
    const LightVolume* light_ = nullptr;
    float extinctionPerCell_ = 0;
    bool burning_ = false;
};

}  // namespace dustbench::raycast
