// A coarse mesh that stands for a fine one when it is voxelised: vertices in the same cube of a lattice are merged at
// their mean, and triangles that shrink to a line are dropped. A closed mesh stays closed.
//
// Units: metres. Frame: the mesh's. Owns: its mesh. Threads: one writer.
// Source: Crane2007, 30.2.4 (a proxy mesh for complex obstacles). Departs: the proxy is made, not modelled.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::grid_fluid {

class ProxyMesh {
 public:
    /// `edgeMetres`: of the lattice's cubes.
    ProxyMesh(const scene::Mesh& mesh, float edgeMetres);

    /// Follows the mesh as it deforms: each vertex has the mean position and velocity of those that it stands for.
    /// `velocities` may be empty.
    void follow(const scene::Mesh& mesh, std::span<const glm::vec3> velocities);

    /// Has positions and indices only.
    [[nodiscard]] const scene::Mesh& mesh() const { return proxy_; }
    [[nodiscard]] std::span<const glm::vec3> velocities() const { return velocities_; }

 private:
    void takeMeans(std::span<const glm::vec3> values, std::vector<glm::vec3>& means) const;

    std::vector<std::uint32_t> clusters_;  ///< of each vertex of the fine mesh
    std::vector<std::uint32_t> sizes_;     ///< of each cluster
    scene::Mesh proxy_;
    std::vector<glm::vec3> velocities_;
};

}  // namespace dustbench::grid_fluid
