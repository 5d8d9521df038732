#include "methods/relief/drawing/car_shadow.h"

#include "relief_drawing_shaders.h"

namespace dustbench::relief {
namespace {

constexpr int texels = 512;  // 12 mm each, as in the opaque scene

}  // namespace

CarShadow::CarShadow(gpu::Device& device, const scene::Scene& scene)
    : model_(*scene.vehicle),
      body_(device, model_.body),
      wheel_(device, model_.wheel),
      // The wheels extend slightly beyond the body, below and ahead.
      map_(device, "relief car shadow", texels,
           static_cast<double>(body_.radiusMetres()) + 2 * static_cast<double>(wheel_.radiusMetres()),
           scene.lights.toSun),
      caster_(device, "relief car shadow",
              {relief_drawing_shaders::car_shadow_vert, relief_drawing_shaders::car_shadow_frag}) {}

void CarShadow::draw(const scene::SceneState& state) {
    const scene::VehiclePoses poses = scene::vehiclePoses(model_, state.vehicle);
    map_.aim(glm::dvec3(poses.body.toWorld * glm::vec4(body_.centre(), 1)));
    const glm::mat4 toLight = map_.eyeToLight(glm::dvec3(0));
    const gpu::DrawState casting{.depthTest = true, .depthWrite = true};
    map_.bindAndClear();
    caster_.set("toLight", toLight * poses.body.toWorld);
    body_.draw(caster_, casting);
    for (const scene::SolidPose& pose : poses.wheels) {
        caster_.set("toLight", toLight * pose.toWorld);
        wheel_.draw(caster_, casting);
    }
}

glm::mat4 CarShadow::fromPanel(const glm::dmat4& panelToWorld) const {
    return glm::mat4(glm::dmat4(map_.eyeToTexture(glm::dvec3(0))) * panelToWorld);
}

}  // namespace dustbench::relief
