// Ray casting of a sparse grid on the CPU: sixteen neighbouring pixels at a time, in parallel.
//
// Takes the same steps as the march through a dense grid (kit/raycast/cpu_march.h) and skips nodes of the tree without
// density. Units: cells. Threads: march() uses the current oneTBB arena; the picture does not depend on the
// number of threads. Source: Senger2009, ch. 4; Museth2021.
#pragma once

#include <vector>

#include "methods/kit/raycast/cpu_march.h"
#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {

class SparseMarch {
 public:
    explicit SparseMarch(const raycast::RaycastSettings& settings);

    /// `moment`, and `light` if the cloud casts a shadow on itself, must outlive all marches through it.
    void set(const SparseMoment& moment, const raycast::LightVolume* light);

    /// 1 for smoke of uniform colour, otherwise 4.
    [[nodiscard]] int channels() const { return burning() || light_ ? 4 : 1; }
    /// `picture.channels` must equal `channels()`.
    void march(const raycast::PixelRays& rays, const raycast::SceneDepths& depths, const raycast::Reflected& reflected,
               const raycast::PacketPicture& picture) const;

 private:
    [[nodiscard]] bool burning() const { return moment_ && !moment_->reaction.empty(); }

    raycast::RaycastSettings settings_;
    std::vector<glm::vec4> fire_;
    const SparseMoment* moment_ = nullptr;
    const raycast::LightVolume* light_ = nullptr;
};

}  // namespace dustbench::volume
