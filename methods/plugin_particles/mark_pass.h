// Draws the parts of a system that show themselves: discs, balls and crosses.
//
// Owns: their meshes, on the GPU. Threads: the OpenGL thread. Source: Thesis, Figures 5.2, 5.5 and 6.2.
#pragma once

#include <array>
#include <span>

#include "methods/kit/draw/mesh_instances.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::plugin_particles {

class MarkPass {
 public:
    MarkPass(gpu::Device& device, const scene::Lights& lights);

    void upload(std::span<const particles::Mark> marks);
    /// Draws the last upload; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

 private:
    std::array<draw::MeshInstances, 3> meshes_;  ///< by MarkShape
};

}  // namespace dustbench::plugin_particles
