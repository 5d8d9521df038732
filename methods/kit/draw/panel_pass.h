// Draws the scene's panels without their relief: its colours on the face of a smooth plate.
//
// Units: metres. Owns: meshes and pictures of the panels.
#pragma once

#include <string_view>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/draw/solid_mesh.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

[[nodiscard]] DUSTBENCH_API glm::vec3 meanColour(const scene::Relief& relief);
/// The relief's colours as eight bits, sRGB encoded, with mipmaps.
[[nodiscard]] DUSTBENCH_API gpu::Texture colourTexture(gpu::Device& device, std::string_view label,
                                                       const scene::Relief& relief);

/// The plate's back and rims, in the panel's frame and in the relief's mean colour; its face is open.
[[nodiscard]] scene::Mesh panelPlate(const scene::Panel& panel);

class PanelPass {
 public:
    /// `scene` must outlive the pass.
    PanelPass(gpu::Device& device, const scene::Scene& scene);

    /// Draws faces and plates as seen from `eye`. `vehicle`: relative to the eye. `plates` is the program of solids,
    /// `faces` the same with PANEL defined; both use texture unit 4 for pictures.
    void draw(const glm::dvec3& eye, const scene::VehicleState& vehicle, gpu::Program& plates,
              gpu::Program& faces) const;
    /// Draws the vehicle's panels into its shadow map; `toLight` takes positions relative to the eye.
    void castFromVehicle(const scene::VehicleState& vehicle, const glm::mat4& toLight, gpu::Program& caster) const;

    [[nodiscard]] bool empty() const { return panels_.empty(); }
    /// Largest distance of a vehicle's panel from the vehicle's origin; 0 if there are none.
    [[nodiscard]] double reachOnVehicleMetres() const;

 private:
    struct Placed {
        const scene::Panel& panel;
        SolidMesh plate, face;
        gpu::Texture picture;
    };
    std::vector<Placed> panels_;
};

}  // namespace dustbench::draw
