// The car's shadow on reliefs: a shadow map of body and wheels as seen from the sun.
//
// Units: metres. Owns: the shadow map and the car's meshes. Threads: the OpenGL thread.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/scene.h"
#include "methods/kit/draw/shadow_map.h"
#include "methods/kit/draw/solid_mesh.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::relief {

class CarShadow {
 public:
    /// `scene` must have a vehicle and must outlive this.
    CarShadow(gpu::Device& device, const scene::Scene& scene);

    /// Draws the shadow map for the current moment.
    void draw(const scene::SceneState& state);

    void bind(std::uint32_t unit) const { map_.depth().bind(unit); }
    /// From a panel's frame to the map's texture coordinates and depth.
    [[nodiscard]] glm::mat4 fromPanel(const glm::dmat4& panelToWorld) const;
    [[nodiscard]] std::size_t gpuBytes() const { return map_.depth().bytes(); }

 private:
    const scene::VehicleModel& model_;
    draw::SolidMesh body_, wheel_;
    draw::ShadowMap map_;
    gpu::Program caster_;
};

}  // namespace dustbench::relief
