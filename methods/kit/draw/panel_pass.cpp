#include "methods/kit/draw/panel_pass.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "methods/kit/maths/srgb.h"
#include "methods/kit/meshes/curved_panel.h"

namespace dustbench::draw {
namespace {

constexpr std::uint32_t pictureUnit = 4;

constexpr int cellsOfCurve = 16;

/// A grid over two of the three coordinates of the relief's frame; `alongU` × `alongV` points outwards. `colourAt` gets
/// the shares of both.
template <typename ColourAt>
void append(scene::Mesh& mesh, const scene::Panel& panel, const glm::dvec3& corner, const glm::dvec3& alongU,
            const glm::dvec3& alongV, const ColourAt& colourAt) {
    const bool curved = meshes::isCurved(panel);
    // Edges along the plate's depth are straight.
    const int columns = curved && alongU.z == 0 ? cellsOfCurve : 1, rows = curved && alongV.z == 0 ? cellsOfCurve : 1;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const double u = static_cast<double>(column) / columns, v = static_cast<double>(row) / rows;
            const glm::dvec3 relief = corner + u * alongU + v * alongV;
            const glm::dmat3 axes = meshes::reliefAxes(panel, relief);
            mesh.positions.emplace_back(meshes::fromRelief(panel, relief));
            mesh.normals.emplace_back(glm::normalize(glm::cross(axes * alongU, axes * alongV)));
            mesh.colours.push_back(colourAt(u, v));
        }
    const auto across = static_cast<std::uint32_t>(columns) + 1;
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row)
        for (std::uint32_t column = 0; column + 1 < across; ++column) {
            const std::uint32_t low = first + row * across + column, high = low + across;
            mesh.indices.insert(mesh.indices.end(), {low, low + 1, high + 1, low, high + 1, high});
        }
}

/// The face, with the place in the picture instead of a colour.
scene::Mesh faceOf(const scene::Panel& panel) {
    scene::Mesh mesh;
    append(mesh, panel, {-panel.sizeMetres / 2.0, 0}, {panel.sizeMetres.x, 0, 0}, {0, panel.sizeMetres.y, 0},
           [](double u, double v) { return glm::vec3(u, v, 0); });
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
    const glm::dvec2 half = panel.sizeMetres / 2.0;
    const glm::dvec3 right(panel.sizeMetres.x, 0, 0), up(0, panel.sizeMetres.y, 0), outwards(0, 0, panel.depthMetres);
    const glm::dvec3 lowerLeft(-half, -panel.depthMetres), lowerRight = lowerLeft + right, upperLeft = lowerLeft + up;
    const auto side = [&](const glm::dvec3& corner, const glm::dvec3& alongU, const glm::dvec3& alongV) {
        const glm::vec3 colour = meanColour(*panel.relief);
        append(mesh, panel, corner, alongU, alongV, [&](double, double) { return colour; });
    };
    side(lowerLeft, up, right);  // back
    side(lowerLeft, outwards, up);
    side(lowerRight, up, outwards);
    side(lowerLeft, right, outwards);
    side(upperLeft, outwards, right);
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
        const meshes::PlateBounds box = meshes::boundsOf(placed.panel);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 share(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
            const glm::dvec3 place = glm::mix(box.low, box.high, share);
            reach = std::max(reach, glm::length(glm::dvec3(placed.panel.toParent * glm::dvec4(place, 1))));
        }
    }
    return reach;
}

}  // namespace dustbench::draw
