#include "methods/kit/draw/opaque_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "draw_shaders.h"
#include "methods/kit/draw/ground_pass.h"
#include "methods/kit/draw/opaque_moment.h"
#include "methods/kit/draw/panel_pass.h"
#include "methods/kit/draw/placed_solids.h"
#include "methods/kit/draw/shadow_map.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"

namespace dustbench::draw {
namespace {

constexpr int vehicleShadowTexels = 512;  // 12 mm each; twice as many cost 3 ms more on two cores of llvmpipe
// Their map covers the area around the eye; it is redrawn when the eye has moved a step, or a solid has moved.
constexpr int solidShadowTexels = 2048;
constexpr double solidShadowReachMetres = 80;
constexpr double solidShadowStepMetres = 32;
constexpr double vehicleMarginMetres = 0.8;  // the darkening around the vehicle reaches 0.7 m
constexpr float bodyGloss = 1;
constexpr float wheelGloss = 0.1f;
constexpr float solidGloss = 0.1f;

std::map<std::string, std::string> onPanels(std::map<std::string, std::string> definitions) {
    definitions.emplace("PANEL", "1");
    return definitions;
}

gpu::Program solidProgramOf(gpu::Device& device, std::string_view label,
                            const std::map<std::string, std::string>& definitions) {
    using namespace draw_shaders;
    return {device,
            label,
            {opaque_moment_glsl, opaque_shadow_glsl, error_function_glsl, opaque_dust_glsl, opaque_lamps_glsl,
             opaque_solid_vert, opaque_solid_frag},
            definitions};
}

/// The programs for solids and vehicle, and for panels if they are visible.
struct SolidPrograms {
    SolidPrograms(gpu::Device& device, const scene::Scene& scene, bool panels, bool lamps)
        : solid(solidProgramOf(device, "solid", opaqueDefinitions(scene, lamps))) {
        if (panels) panel.emplace(solidProgramOf(device, "panel", onPanels(opaqueDefinitions(scene, lamps))));
    }
    gpu::Program solid;
    std::optional<gpu::Program> panel;
};

glm::mat4 moved(glm::mat4 matrix, const glm::dvec3& by) {
    matrix[3] = glm::vec4(glm::vec3(glm::dvec3(matrix[3]) + by), 1);
    return matrix;
}

/// The vehicle relative to `origin`, so that later arithmetic in floats is precise.
scene::VehicleState relativeTo(scene::VehicleState vehicle, const glm::dvec3& origin) {
    vehicle.position -= origin;
    for (scene::WheelState& wheel : vehicle.wheels) {
        wheel.hub -= origin;
        wheel.contact -= origin;
    }
    return vehicle;
}

/// Whether a sphere may be in view; the inside is −w ≤ x ≤ w, −w ≤ y ≤ w and w ≥ 0.
bool mayBeSeen(const glm::mat4& eyeToClip, const glm::vec3& centre, float radius) {
    const glm::mat4 rows = glm::transpose(eyeToClip);
    for (const glm::vec4& plane : {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3]})
        if (glm::dot(plane, glm::vec4(centre, 1)) < -radius * glm::length(glm::vec3(plane))) return false;
    return true;
}

glm::vec4 with(const glm::vec3& colour, float fourth = 0) {
    return {colour, fourth};
}

}  // namespace

struct OpaqueScene::Targets {
    Targets(gpu::Device& usedBy, int width, int height) : device(usedBy) { resize(width, height); }

    void resize(int width, int height) {
        colour = gpu::Texture::make2D(device, "scene colour", gpu::Format::rgba16F, width, height);
        depth = gpu::Texture::make2D(device, "scene depth", gpu::Format::depth32F, width, height);
        target = gpu::Framebuffer(device, "scene", &colour, &depth);
    }

    gpu::Device& device;
    gpu::Texture colour;
    gpu::Texture depth;
    gpu::Framebuffer target;
};

struct OpaqueScene::State {
    State(const scene::Scene& shown, gpu::Device& device, ScenePanels panelsShown);

    void aimVehicleShadow(const glm::dvec3& eye, const scene::VehiclePoses& poses,
                          const scene::VehicleState& vehicleToEye);
    void aimSolidShadow(const glm::dvec3& eye);
    void findFootprints(const glm::dvec3& eye, const scene::VehiclePoses& poses);
    void describe(const scene::View& view, const scene::VehicleState& vehicle);
    void light(std::span<const scene::PointLight> lamps, const glm::dvec3& eye);
    void drawSolids(gpu::Program& program, const glm::dvec3& eye);
    void drawVehicle(gpu::Program& program, const scene::VehiclePoses& poses);
    void drawPanels(SolidPrograms& programs, const glm::dvec3& eye, const scene::VehicleState& vehicleToEye);

    const scene::Scene& scene;
    gpu::Device& device;

    GroundPass ground;
    PanelPass panels;
    bool panelsSeen;
    PlacedSolids solids;
    std::optional<SolidMesh> body;
    std::optional<SolidMesh> wheel;
    std::optional<ShadowMap> vehicleShadow;
    std::optional<ShadowMap> solidShadow;
    std::optional<DustShadow> dustShadow;

    gpu::Program casterProgram;
    SolidPrograms programs;
    std::optional<SolidPrograms> programsWithLamps;  ///< made for the first lamp
    gpu::Program skyProgram;
    gpu::VertexArray noVertices;
    gpu::Buffer momentBlock;
    gpu::Buffer lampBlock;
    OpaqueMoment now;
    std::optional<glm::dvec3> solidShadowCentre;
    std::vector<GroundRectangle> footprints;
};

OpaqueScene::State::State(const scene::Scene& shown, gpu::Device& drawnBy, ScenePanels panelsShown)
    : scene(shown),
      device(drawnBy),
      ground(device, shown),
      panels(device, shown),
      panelsSeen(panelsShown == ScenePanels::flat && !panels.empty()),
      solids(shown, device),
      casterProgram(device, "shadow caster", {draw_shaders::opaque_caster_vert, draw_shaders::opaque_caster_frag}),
      programs(device, shown, panelsSeen, false),
      skyProgram(device, "sky",
                 {draw_shaders::opaque_moment_glsl, draw_shaders::opaque_sky_vert, draw_shaders::opaque_sky_frag}),
      noVertices(device),
      momentBlock(device, "scene moment", sizeof(OpaqueMoment)) {
    const glm::vec3 toSun = scene.lights.toSun;
    if (scene.lights.onDust) dustShadow.emplace(device, toSun);
    if (scene.vehicle) {
        body.emplace(device, scene.vehicle->body);
        wheel.emplace(device, scene.vehicle->wheel);
        // The wheels extend slightly beyond the body, below and ahead.
        const double ofCar = static_cast<double>(body->radiusMetres()) + 2 * static_cast<double>(wheel->radiusMetres());
        const double ofPanels = panels.reachOnVehicleMetres() + static_cast<double>(glm::length(body->centre()));
        vehicleShadow.emplace(device, "vehicle shadow", vehicleShadowTexels, std::max(ofCar, ofPanels), toSun);
    }
    if (!solids.all().empty())
        solidShadow.emplace(device, "solid shadow", solidShadowTexels, solidShadowReachMetres, toSun);
}

void OpaqueScene::State::aimSolidShadow(const glm::dvec3& eye) {
    glm::dvec3 centre = glm::floor(eye / solidShadowStepMetres + 0.5) * solidShadowStepMetres;
    centre.y = 0;
    if (solidShadowCentre == centre) return;
    solidShadowCentre = centre;
    solidShadow->aim(centre);
    solidShadow->bindAndClear();
    const glm::mat4 toLight = solidShadow->eyeToLight(centre);
    for (const PlacedSolid& solid : solids.all()) {
        if (!solid.touches(centre, solidShadowReachMetres)) continue;
        casterProgram.set("toLight", toLight * moved(solid.toWorld, -centre));
        solid.mesh->draw(casterProgram, {.depthTest = true, .depthWrite = true});
    }
}

void OpaqueScene::State::aimVehicleShadow(const glm::dvec3& eye, const scene::VehiclePoses& poses,
                                          const scene::VehicleState& vehicleToEye) {
    vehicleShadow->aim(eye + glm::dvec3(poses.body.toWorld * glm::vec4(body->centre(), 1)));
    const glm::mat4 toLight = vehicleShadow->eyeToLight(eye);
    const gpu::DrawState state{.depthTest = true, .depthWrite = true};
    vehicleShadow->bindAndClear();
    casterProgram.set("toLight", toLight * poses.body.toWorld);
    body->draw(casterProgram, state);
    for (const scene::SolidPose& pose : poses.wheels) {
        casterProgram.set("toLight", toLight * pose.toWorld);
        wheel->draw(casterProgram, state);
    }
    panels.castFromVehicle(vehicleToEye, toLight, casterProgram);
}

void OpaqueScene::State::findFootprints(const glm::dvec3& eye, const scene::VehiclePoses& poses) {
    footprints.clear();
    const glm::dvec2 below(eye.x, eye.z);
    for (const GroundRectangle& footprint : solids.footprints()) {
        const glm::dvec2 nearest = glm::clamp(below, footprint.minimum, footprint.maximum);
        if (glm::distance(nearest, below) < solidShadowReachMetres) footprints.push_back(footprint);
    }
    if (!body) return;
    glm::dmat4 toWorld(poses.body.toWorld);
    toWorld[3] += glm::dvec4(eye, 0);
    footprints.push_back(shadowFootprint(body->minimum(), body->maximum(), toWorld, scene.lights.toSun, scene.terrain,
                                         vehicleMarginMetres));
}

void OpaqueScene::State::describe(const scene::View& view, const scene::VehicleState& vehicle) {
    const glm::dvec3& eye = view.camera.eye;
    scene::View centred = view;
    centred.camera.eye = glm::dvec3(0);
    centred.camera.target -= eye;
    const scene::Lights& lights = scene.lights;
    now.eyeToClip = centred.worldToClip();
    now.clipToEye = glm::mat4(glm::inverse(glm::dmat4(now.eyeToClip)));
    now.toSun = with(glm::normalize(lights.toSun));
    now.sun = with(lights.sun);
    now.ambient = with(lights.ambient);
    now.groundLight = with(GroundPass::albedo(scene) * (lights.sun * std::max(lights.toSun.y, 0.0f) + lights.ambient));
    now.skyZenith = with(lights.skyZenith);
    now.skyHorizon = with(lights.skyHorizon, lights.hazePerMetre);
    if (body) {
        now.eyeToVehicleShadow = vehicleShadow->eyeToTexture(eye);
        now.shadowTexels.x = static_cast<float>(vehicleShadow->texelMetres());
        now.eyeToVehicle = glm::mat4(glm::inverse(relativeTo(vehicle, eye).toWorld()));
        now.underside = {body->centre().x, body->centre().z, (body->maximum().x - body->minimum().x) / 2 - 0.3f,
                         (body->maximum().z - body->minimum().z) / 2 - 0.2f};
    }
    if (dustShadow) now.eyeToDust = dustShadow->eyeToTexture(eye);
    if (solidShadow) {
        now.eyeToSolidShadow = solidShadow->eyeToTexture(eye);
        now.shadowTexels.y = static_cast<float>(solidShadow->texelMetres());
    }
    std::memcpy(momentBlock.mapForWriting(sizeof now), &now, sizeof now);
    momentBlock.unmap();
    momentBlock.bindUniform(0);
}

void OpaqueScene::State::light(std::span<const scene::PointLight> lamps, const glm::dvec3& eye) {
    if (lamps.empty()) return;
    if (!programsWithLamps) {
        programsWithLamps.emplace(device, scene, panelsSeen, true);
        lampBlock = gpu::Buffer(device, "scene lamps", sizeof(OpaqueLamps));
    }
    OpaqueLamps block;
    block.count.x = static_cast<int>(lamps.size());
    for (std::size_t i = 0; i < lamps.size(); ++i)
        block.lamps[i] = {with(glm::vec3(lamps[i].position - eye), lamps[i].radiusMetres * lamps[i].radiusMetres),
                          with(lamps[i].intensity)};
    std::memcpy(lampBlock.mapForWriting(sizeof block), &block, sizeof block);
    lampBlock.unmap();
    lampBlock.bindUniform(1);
}

void OpaqueScene::State::drawSolids(gpu::Program& program, const glm::dvec3& eye) {
    program.set("gloss", solidGloss);
    for (const PlacedSolid& solid : solids.all()) {
        if (solid.castsOnly) continue;
        if (!mayBeSeen(now.eyeToClip, glm::vec3(solid.centre - eye), static_cast<float>(solid.radiusMetres))) continue;
        program.set("toEye", moved(solid.toWorld, -eye));
        solid.mesh->draw(program, {.depthTest = true, .depthWrite = true});
    }
}

void OpaqueScene::State::drawVehicle(gpu::Program& program, const scene::VehiclePoses& poses) {
    const gpu::DrawState state{.depthTest = true, .depthWrite = true, .cullBackFaces = true};
    program.set("gloss", bodyGloss);
    program.set("toEye", poses.body.toWorld);
    body->draw(program, state);
    program.set("gloss", wheelGloss);
    for (const scene::SolidPose& pose : poses.wheels) {
        program.set("toEye", pose.toWorld);
        wheel->draw(program, state);
    }
}

void OpaqueScene::State::drawPanels(SolidPrograms& drawn, const glm::dvec3& eye,
                                    const scene::VehicleState& vehicleToEye) {
    for (gpu::Program* program : {&drawn.solid, &*drawn.panel}) program->set("gloss", solidGloss);
    panels.draw(eye, vehicleToEye, drawn.solid, *drawn.panel);
}

OpaqueScene::OpaqueScene(const scene::Scene& scene, gpu::Device& device, int width, int height, ScenePanels panels)
    : OpaqueScene(scene, device, width, height, panels, Scenery::drawn) {}

OpaqueScene::OpaqueScene(const scene::Scene& scene, gpu::Device& device, int width, int height, ScenePanels panels,
                         Scenery scenery)
    : targets_(std::make_unique<Targets>(device, width, height)), background_(scene.lights.skyHorizon) {
    if (scenery == Scenery::drawn) state_ = std::make_unique<State>(scene, device, panels);
}

OpaqueScene::~OpaqueScene() = default;

void OpaqueScene::draw(const scene::SceneState& state, const scene::View& view,
                       std::span<const scene::PointLight> lamps, const Puffs& dust) {
    if (lamps.size() > maximumLamps)
        throw std::invalid_argument("OpaqueScene: more lamps than " + std::to_string(maximumLamps));
    if (view.width != colour().width() || view.height != colour().height())
        throw std::invalid_argument("OpaqueScene: the view's size differs from the scene's");
    if (!state_) {
        targets_->target.bind();
        targets_->target.clearColour(background_.r, background_.g, background_.b, 1);
        targets_->target.clearDepth();
        return;
    }
    State& own = *state_;
    const glm::dvec3& eye = view.camera.eye;
    const scene::VehicleState vehicleToEye = relativeTo(state.vehicle, eye);
    scene::VehiclePoses poses;
    if (own.body) {
        poses = scene::vehiclePoses(*own.scene.vehicle, vehicleToEye);
        own.aimVehicleShadow(eye, poses, vehicleToEye);
    }
    if (own.solids.moveTo(state)) own.solidShadowCentre.reset();
    if (own.solidShadow) own.aimSolidShadow(eye);
    if (own.dustShadow) own.dustShadow->set(dust);
    own.describe(view, state.vehicle);
    own.light(lamps, eye);
    SolidPrograms& programs = lamps.empty() ? own.programs : *own.programsWithLamps;
    own.findFootprints(eye, poses);

    targets_->target.bind();
    targets_->target.clearDepth();  // ground and sky cover every pixel: the colour needs no clearing
    if (own.vehicleShadow) own.vehicleShadow->depth().bind(2);
    if (own.solidShadow) own.solidShadow->depth().bind(3);
    if (own.dustShadow) own.dustShadow->columns().bind(5);
    own.ground.draw(eye, own.now.eyeToClip, own.footprints, !lamps.empty());
    own.drawSolids(programs.solid, eye);
    if (own.body) own.drawVehicle(programs.solid, poses);
    if (own.panelsSeen) own.drawPanels(programs, eye, vehicleToEye);
    // Drawn last, so that the depth test skips the sky's shader behind other surfaces.
    gpu::draw(own.skyProgram, own.noVertices, {.depthTest = true}, gpu::Primitives::triangles, 3);
}

void OpaqueScene::resize(int width, int height) {
    targets_->resize(width, height);
}

const gpu::Texture& OpaqueScene::colour() const {
    return targets_->colour;
}

const gpu::Texture& OpaqueScene::depth() const {
    return targets_->depth;
}

}  // namespace dustbench::draw
