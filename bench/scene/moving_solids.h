// The solids of a scene that move or deform, and the state of all solids at a given time.
//
// Units: s, m. Frame: world. Owns: paths and targets. Threads: const members are safe from any.
#pragma once

#include <optional>
#include <vector>

#include "bench/scene/solid_path.h"
#include "methods/contract/scene.h"
#include "methods/kit/meshes/mesh_file.h"

namespace dustbench::bench {

class MovingSolids {
 public:
    /// Gives the solid with this number a path. `morph`: its targets, if it deforms.
    void add(std::size_t solid, SolidPath path, double scale, std::optional<meshes::MorphMesh> morph);

    /// All solids of the scene at this time; empty if none of them moves.
    [[nodiscard]] std::vector<scene::SolidNow> at(const scene::Scene& scene, double seconds) const;
    /// Memory of the targets.
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
