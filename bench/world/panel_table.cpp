#include "bench/world/panel_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/meshes/curved_panel.h"
#include "methods/kit/pictures/picture_files.h"

namespace dustbench::world {
namespace {

constexpr double far = 1e5;        // metres: the maximum coordinate in a file
constexpr double touching = 1e-6;  // metres: plates that only touch do not overlap
constexpr Choices<scene::Panel::Parent> parents{{"world", scene::Panel::Parent::world},
                                                {"vehicle", scene::Panel::Parent::vehicle}};

/// The half edges of a box around a plate as vectors, and its centre.
struct Box {
    glm::dvec3 middle;
    std::array<glm::dvec3, 3> half;
};

Box boxOf(const scene::Panel& panel) {
    const glm::dmat4& pose = panel.toParent;
    const meshes::PlateBounds bounds = meshes::boundsOf(panel);
    const glm::dvec3 half = (bounds.high - bounds.low) / 2.0;
    return {glm::dvec3(pose * glm::dvec4((bounds.low + bounds.high) / 2.0, 1)),
            {glm::dvec3(pose[0]) * half.x, glm::dvec3(pose[1]) * half.y, glm::dvec3(pose[2]) * half.z}};
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

/// The slope at the rim is at most 1, and the relief's frame has one place for each point of the plate and its
/// surroundings.
glm::dvec2 readCurvature(files::TomlReader& table, const scene::Panel& panel) {
    if (!table.has("curvature_per_metre")) return glm::dvec2(0);
    const std::vector<double> curvature = table.numbers("curvature_per_metre", 2);
    const glm::dvec2 most = glm::min(2.0 / panel.sizeMetres, glm::dvec2(0.25 / panel.depthMetres));
    if (curvature.size() != 2 || !(std::abs(curvature[0]) <= most.x) || !(std::abs(curvature[1]) <= most.y))
        throw InputError(
            table.where("curvature_per_metre") +
            fmt::format("key 'curvature_per_metre': got [{}], expected two numbers, along width and height, within "
                        "-{:.3g}..{:.3g} and -{:.3g}..{:.3g} for this size and depth",
                        fmt::join(curvature, ", "), most.x, most.x, most.y, most.y));
    return {curvature[0], curvature[1]};
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

constexpr int minimumTexels = 2, maximumTexels = files::limits::heightEdge;

std::string sizeOf(const pictures::StoredPicture& picture) {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

/// Checks the size before any pixel is read: a picture that is too large may not fit into memory.
void requireSize(const std::filesystem::path& file) {
    pictures::StoredPicture picture;
    if (const std::string reason = pictures::readPictureSize(file, picture); !reason.empty())
        throw InputError(file.string() + ": not an image that can be read: " + reason);
    if (std::min(picture.width, picture.height) < minimumTexels ||
        std::max(picture.width, picture.height) > maximumTexels)
        throw InputError(file.string() + ": has " + sizeOf(picture) + " texels, allowed: 2.." +
                         std::to_string(maximumTexels) + " a side");
}

pictures::StoredPicture readPicture(const std::filesystem::path& file) {
    requireSize(file);
    pictures::StoredPicture picture;
    if (const std::string reason = pictures::readPicture(file, picture); !reason.empty())
        throw InputError(file.string() + ": not an image that can be read: " + reason);
    return picture;
}

/// Calls `visit(texel, value)` for the pixels from the bottom row up, the order of a relief.
template <typename Visit>
void forEachTexel(const pictures::StoredPicture& picture, const Visit& visit) {
    const auto columns = static_cast<std::size_t>(picture.width), rows = static_cast<std::size_t>(picture.height);
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            visit(row * columns + column, &picture.values[((rows - 1 - row) * columns + column) * channels]);
}

void readDepths(const std::filesystem::path& file, scene::Relief& relief) {
    const pictures::StoredPicture heights = readPicture(file);
    files::noteIgnored(file, pictures::unusedParts(heights, 1, false));
    relief.columns = heights.width;
    relief.rows = heights.height;
    relief.depth.resize(static_cast<std::size_t>(heights.width) * static_cast<std::size_t>(heights.height));
    forEachTexel(heights, [&](std::size_t texel, const float* value) {
        if (!(value[0] >= 0 && value[0] <= 1))
            throw InputError(file.string() + ": a height is " + std::to_string(value[0]) + ", allowed: 0..1");
        relief.depth[texel] = 1 - value[0];
    });
}

void readColours(const std::filesystem::path& file, scene::Relief& relief) {
    const pictures::StoredPicture colours = readPicture(file);
    if (const std::string reason = colours.encoding.refusal(); !reason.empty())
        throw InputError(file.string() + ": " + reason);
    if (colours.width != relief.columns || colours.height != relief.rows)
        throw InputError(file.string() + ": the colours have " + sizeOf(colours) + " texels, expected those of the " +
                         "heights, " + std::to_string(relief.columns) + "x" + std::to_string(relief.rows));
    files::noteIgnored(file, pictures::unusedParts(colours, colours.channels >= 3 ? 3 : 1, false));
    const auto green = static_cast<std::size_t>(colours.channels >= 3 ? 1 : 0), blue = 2 * green;
    forEachTexel(colours, [&](std::size_t texel, const float* value) {
        const glm::vec3 stored(value[0], value[green], value[blue]);
        for (int i = 0; i < 3; ++i)
            if (!(stored[i] >= 0 && stored[i] <= 1))
                throw InputError(file.string() + ": a colour is " + std::to_string(stored[i]) + ", allowed: 0..1");
        for (int i = 0; i < 3; ++i) relief.colour[texel][i] = colours.encoding.decoded(stored[i]);
    });
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
    panel.curvaturePerMetre = readCurvature(table, panel);
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

ReliefFile readRelief(const std::filesystem::path& file) {
    files::TomlReader root = files::TomlReader::parseFile(file);
    ReliefFile result;
    result.files.push_back(file);
    result.description = root.text("description");
    const std::filesystem::path folder = file.parent_path();
    const auto relief = std::make_shared<scene::Relief>();

    const std::filesystem::path heights = folder / root.text("heights");
    result.files.push_back(heights);
    readDepths(heights, *relief);

    const glm::dvec3 colour = root.vector3("colour", glm::dvec3(0.5));
    for (int i = 0; i < 3; ++i)
        if (!(colour[i] >= 0 && colour[i] <= 1))
            throw InputError(root.where("colour") + "key 'colour': expected a linear RGB colour, each 0..1");
    relief->colour.assign(relief->depth.size(), glm::vec3(colour));
    if (root.has("colours")) {
        const std::filesystem::path colours = folder / root.text("colours");
        result.files.push_back(colours);
        readColours(colours, *relief);
    }
    root.finish();
    result.relief = relief;
    return result;
}

}  // namespace dustbench::world
