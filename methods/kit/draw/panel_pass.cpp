#include "methods/kit/draw/panel_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "methods/kit/maths/srgb.h"

namespace dustbench::draw {
namespace {

constexpr std::uint32_t pictureUnit = 4;

/// A quadrilateral with corners counter-clockwise seen from outside, and a colour for each corner.
void append(scene::Mesh& mesh, const std::array<glm::vec3, 4>& corners, const std::array<glm::vec3, 4>& colours) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    mesh.normals.insert(mesh.normals.end(), 4, normal);
    mesh.colours.insert(mesh.colours.end(), colours.begin(), colours.end());
    for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + corner);
}

/// The plate's eight corners: bit 0 is +x, bit 1 is +y, bit 2 is the face.
glm::vec3 cornerOf(const scene::Panel& panel, int bits) {
    const glm::dvec2 half = panel.sizeMetres / 2.0;
    return {(bits & 1) != 0 ? half.x : -half.x, (bits & 2) != 0 ? half.y : -half.y,
            (bits & 4) != 0 ? 0.0 : -panel.depthMetres};
}

/// The face, with the place in the picture instead of a colour.
scene::Mesh faceOf(const scene::Panel& panel) {
    scene::Mesh mesh;
    append(mesh, {cornerOf(panel, 4), cornerOf(panel, 5), cornerOf(panel, 7), cornerOf(panel, 6)},
           {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)});
    return mesh;
}

SolidMesh meshOf(gpu::Device& device, const scene::Panel& panel, scene::Mesh mesh) {
    return {device, {panel.name, std::make_shared<const scene::Mesh>(std::move(mesh))}};
}

}  // namespace

glm::vec3 meanColour(const scene::Relief& relief) {
    glm::dvec3 sum(0);
    for (const glm::vec3& colour : relief.colour) sum += glm::dvec3(colour);
    return glm::vec3(sum / static_cast<double>(relief.colour.size()));
}

gpu::Texture colourTexture(gpu::Device& device, std::string_view label, const scene::Relief& relief) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(4 * relief.colour.size());
    for (const glm::vec3& colour : relief.colour) {
        for (int i = 0; i < 3; ++i)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * maths::encodeSrgb(colour[i]))));
        bytes.push_back(255);
    }
    gpu::Texture picture =
        gpu::Texture::make2D(device, label, gpu::Format::srgba8, relief.columns, relief.rows, gpu::Filter::mipmapped);
    picture.write(bytes);
    return picture;
}

scene::Mesh panelPlate(const scene::Panel& panel) {
    scene::Mesh mesh;
    std::array<glm::vec3, 4> colours;
    colours.fill(meanColour(*panel.relief));
    constexpr std::array<std::array<int, 4>, 5> sides{
        {{0, 2, 3, 1}, {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}}};  // back, left, right, lower, upper
    for (const std::array<int, 4>& side : sides)
        append(mesh,
               {cornerOf(panel, side[0]), cornerOf(panel, side[1]), cornerOf(panel, side[2]), cornerOf(panel, side[3])},
               colours);
    return mesh;
}

PanelPass::PanelPass(gpu::Device& device, const scene::Scene& scene) {
    panels_.reserve(scene.panels.size());
    for (const scene::Panel& panel : scene.panels)
        panels_.push_back({panel, meshOf(device, panel, panelPlate(panel)), meshOf(device, panel, faceOf(panel)),
                           colourTexture(device, "panel picture", *panel.relief)});
}

void PanelPass::draw(const glm::dvec3& eye, const scene::VehicleState& vehicle, gpu::Program& plates,
                     gpu::Program& faces) const {
    const gpu::DrawState state{.depthTest = true, .depthWrite = true, .cullBackFaces = true};
    for (const Placed& placed : panels_) {
        glm::dmat4 toEye = placed.panel.toParent;
        if (placed.panel.parent == scene::Panel::Parent::vehicle)
            toEye = vehicle.toWorld() * toEye;
        else
            toEye = glm::translate(glm::dmat4(1), -eye) * toEye;
        plates.set("toEye", glm::mat4(toEye));
        placed.plate.draw(plates, state);
        faces.set("toEye", glm::mat4(toEye));
        placed.picture.bind(pictureUnit);
        placed.face.draw(faces, state);
    }
}

void PanelPass::castFromVehicle(const scene::VehicleState& vehicle, const glm::mat4& toLight,
                                gpu::Program& caster) const {
    for (const Placed& placed : panels_) {
        if (placed.panel.parent != scene::Panel::Parent::vehicle) continue;
        caster.set("toLight", toLight * glm::mat4(vehicle.toWorld() * placed.panel.toParent));
        placed.plate.draw(caster, {.depthTest = true, .depthWrite = true});
    }
}

double PanelPass::reachOnVehicleMetres() const {
    double reach = 0;
    for (const Placed& placed : panels_) {
        if (placed.panel.parent != scene::Panel::Parent::vehicle) continue;
        for (int corner = 0; corner < 8; ++corner)
            reach = std::max(reach, glm::length(glm::dvec3(placed.panel.toParent *
                                                           glm::dvec4(glm::dvec3(cornerOf(placed.panel, corner)), 1))));
    }
    return reach;
}

}  // namespace dustbench::draw
