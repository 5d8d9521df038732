// The solids of a scene that move or deform, and how all of them are at a time.
//
// Units: s, m. Frame: world. Owns: paths and targets. Threads: const members are safe from any.
#pragma once

#include <optional>
#include <vector>

#include "bench/scene/solid_path.h"
#include "methods/contract/scene.h"
#include "methods/kit/meshes/morph_mesh.h"

namespace dustbench::bench {

class MovingSolids {
 public:
    /// The solid of this number takes this path. `morph`: of one that deforms.
    void add(std::size_t solid, SolidPath path, double scale, std::optional<meshes::MorphMesh> morph);

    /// All solids of the scene at this time; none where all of them are still.
    [[nodiscard]] std::vector<scene::SolidNow> at(const scene::Scene& scene, double seconds) const;
    /// Of the targets.
    [[nodiscard]] std::size_t bytes() const;

 private:
    struct Moving {
        std::size_t solid;
        SolidPath path;
        double scale;
        std::optional<meshes::MorphMesh> morph;
    };
    std::vector<Moving> all_;
};

}  // namespace dustbench::bench
