#include "bench/scene/panel_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "bench/scene/relief_file.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::bench {
namespace {

constexpr double far = 1e5;        // metres: the maximum coordinate in a file
constexpr double touching = 1e-6;  // metres: plates that only touch do not overlap
constexpr Choices<scene::Panel::Parent> parents{{"world", scene::Panel::Parent::world},
                                                {"vehicle", scene::Panel::Parent::vehicle}};

/// The half edges of a plate as vectors, and its centre.
struct Box {
    glm::dvec3 middle;
    std::array<glm::dvec3, 3> half;
};

Box boxOf(const scene::Panel& panel) {
    const glm::dmat4& pose = panel.toParent;
    return {glm::dvec3(pose * glm::dvec4(0, 0, -panel.depthMetres / 2, 1)),
            {glm::dvec3(pose[0]) * (panel.sizeMetres.x / 2), glm::dvec3(pose[1]) * (panel.sizeMetres.y / 2),
             glm::dvec3(pose[2]) * (panel.depthMetres / 2)}};
}

double reachAlong(const Box& box, const glm::dvec3& axis) {
    double reach = 0;
    for (const glm::dvec3& half : box.half) reach += std::abs(glm::dot(half, axis));
    return reach;
}

std::vector<glm::dvec3> cornersOf(const Box& box) {
    std::vector<glm::dvec3> corners;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 place = box.middle;
        for (std::size_t axis = 0; axis < 3; ++axis) place += ((corner >> axis) & 1 ? 1.0 : -1.0) * box.half[axis];
        corners.push_back(place);
    }
    return corners;
}

bool reachesIntoGround(const scene::Panel& panel, const scene::Terrain& terrain) {
    for (const glm::dvec3& corner : cornersOf(boxOf(panel)))
        if (corner.y <
            static_cast<double>(terrain.heightAt(static_cast<float>(corner.x), static_cast<float>(corner.z))) -
                touching)
            return true;
    return false;
}

glm::dmat4 pose(const glm::dvec3& position, const glm::dvec3& turn) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), position);
    matrix = glm::rotate(matrix, turn.y, {0, 1, 0});
    matrix = glm::rotate(matrix, turn.z, {0, 0, 1});
    return glm::rotate(matrix, turn.x, {1, 0, 0});
}

glm::dvec2 readSize(files::TomlReader& table) {
    const std::vector<double> size = table.numbers("size_metres", 2);
    if (size.size() != 2 || !(size[0] >= 0.01 && size[0] <= 1000) || !(size[1] >= 0.01 && size[1] <= 1000))
        throw InputError(table.where("size_metres") +
                         fmt::format("key 'size_metres': got [{}], expected two numbers 0.01..1000, width and height",
                                     fmt::join(size, ", ")));
    return {size[0], size[1]};
}

std::shared_ptr<const scene::Relief> readReliefOf(files::TomlReader& table, const std::filesystem::path& sceneFile,
                                                  std::vector<std::filesystem::path>& files) {
    const std::string relief = files::fromFile(sceneFile, table.text("relief"), ".toml");
    try {
        ReliefFile read = readRelief(files::findData("relief", "reliefs", relief, ".toml"));
        files.insert(files.end(), read.files.begin(), read.files.end());
        return read.relief;
    } catch (const InputError& error) {
        throw InputError(table.where("relief") + error.what());
    }
}

void checkPlace(const scene::Panel& panel, const scene::Scene& scene, const std::string& where) {
    if (panel.parent == scene::Panel::Parent::world && reachesIntoGround(panel, scene.terrain))
        throw InputError(where + "panel '" + panel.name + "' extends into the ground, expected it above");
    for (const scene::Panel& other : scene.panels) {
        if (other.name == panel.name)
            throw InputError(where + "two panels have the name '" + panel.name + "', expected different names");
        if (other.parent == panel.parent && overlap(other, panel))
            throw InputError(where + "panel '" + panel.name + "' overlaps panel '" + other.name +
                             "', expected panels that do not overlap");
    }
}

}  // namespace

// Two boxes are apart if and only if their projections onto one of 15 axes are: the separating axis theorem.
bool overlap(const scene::Panel& one, const scene::Panel& other) {
    const Box a = boxOf(one), b = boxOf(other);
    std::vector<glm::dvec3> axes;
    axes.reserve(15);
    for (const glm::dvec3& edge : a.half) axes.push_back(glm::normalize(edge));
    for (const glm::dvec3& edge : b.half) axes.push_back(glm::normalize(edge));
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 3; j < 6; ++j) {
            const glm::dvec3 across = glm::cross(axes[i], axes[j]);
            if (glm::length(across) > 1e-9) axes.push_back(glm::normalize(across));
        }
    for (const glm::dvec3& axis : axes)
        if (std::abs(glm::dot(a.middle - b.middle, axis)) > reachAlong(a, axis) + reachAlong(b, axis) - touching)
            return false;
    return true;
}

scene::Panel readPanel(files::TomlReader& table, const std::filesystem::path& sceneFile, const scene::Scene& scene,
                       std::vector<std::filesystem::path>& files) {
    scene::Panel panel;
    panel.name = table.text("name");
    panel.parent = table.has("parent") ? table.choice("parent", parents) : scene::Panel::Parent::world;
    panel.sizeMetres = readSize(table);
    panel.depthMetres = table.number("depth_metres", 1e-4, 100);
    glm::dvec3 position = table.vector3("position");
    const glm::dvec3 turn = glm::radians(table.vector3("rotation_degrees", {}));
    const bool onGround = table.boolean("on_ground", panel.parent == scene::Panel::Parent::world);
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(position[i]) <= far) || !std::isfinite(turn[i]))
            throw InputError(table.where("position") + "panel '" + panel.name +
                             "': expected a position within 100000 metres and a finite rotation");
    if (panel.parent == scene::Panel::Parent::vehicle && (onGround || !scene.vehicle))
        throw InputError(table.where("parent") + "panel '" + panel.name +
                         "' is on the vehicle, expected a scene with a vehicle and without on_ground = true");
    if (onGround)
        position.y +=
            static_cast<double>(scene.terrain.heightAt(static_cast<float>(position.x), static_cast<float>(position.z)));
    panel.toParent = pose(position, turn);
    panel.relief = readReliefOf(table, sceneFile, files);
    table.finish();
    checkPlace(panel, scene, table.where("name"));
    return panel;
}

}  // namespace dustbench::bench
