#include "methods/grid_fluid/flow_gl/cells_on_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "grid_fluid_flow_gl_shaders.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

constexpr const char* label = "fluid voxelisation";
constexpr std::size_t crossingBytes = 32;  // as in crossings.glsl
constexpr int group = 64;

glm::ivec3 turned(const glm::ivec3& each, int axis) {
    return {each[axis], each[(axis + 1) % 3], each[(axis + 2) % 3]};
}

/// The maximum number of crossings: the rays within the bounds of each triangle.
std::size_t mostCrossings(std::span<const glm::dvec3> places, std::span<const std::uint32_t> indices, int axis,
                          const glm::ivec3& size) {
    std::size_t most = 0;
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
        std::size_t rays = 1;
        for (int side = 1; side < 3; ++side) {
            const int along = (axis + side) % 3;
            const auto [low, high] =
                std::minmax({places[indices[t]][along], places[indices[t + 1]][along], places[indices[t + 2]][along]});
            const double first = std::max(0.0, std::ceil(low - 0.5)),
                         last = std::min(size[side] - 1.0, std::floor(high - 0.5));
            rays *= static_cast<std::size_t>(std::max(0.0, last - first + 1));
        }
        most += rays;
    }
    return most;
}

}  // namespace

CellsOnRays::CellsOnRays(gpu::Device& device, glm::ivec3 cells)
    : device_(device),
      cells_(cells),
      total_(device, label, sizeof(std::uint32_t)),
      countCrossings_(device, {crossings_glsl, cross_comp}),
      storeCrossings_(device, {crossings_glsl, cross_comp}, {{"STORE", ""}}),
      placeRays_(device, {crossings_glsl, place_rays_comp}),
      fillRays_(device, {crossings_glsl, fill_rays_comp}) {
    const std::size_t x = static_cast<std::size_t>(cells.x), y = static_cast<std::size_t>(cells.y),
                      z = static_cast<std::size_t>(cells.z);
    const std::size_t rays = std::max({x * y, y * z, z * x});
    counts_ = gpu::Buffer(device, label, rays * sizeof(std::uint32_t));
    firsts_ = gpu::Buffer(device, label, rays * sizeof(std::uint32_t));
    bodies_ = gpu::Buffer(device, label, x * y * z * sizeof(std::uint32_t));
}

void CellsOnRays::reserve(gpu::Buffer& buffer, std::size_t bytes) {
    if (buffer.bytes() < bytes) buffer = gpu::Buffer(device_, label, bytes);
}

void CellsOnRays::begin(std::span<const std::uint8_t> bodies) {
    const std::vector<std::uint32_t> words(bodies.begin(), bodies.end());
    bodies_.write(std::span<const std::uint32_t>(words));
}

void CellsOnRays::add(std::span<const glm::dvec3> places, std::span<const std::uint32_t> indices, std::uint8_t body) {
    reserve(places_, places.size_bytes());
    reserve(indices_, indices.size_bytes());
    places_.write(places);
    indices_.write(indices);
    for (int axis = 0; axis < 3; ++axis) sweep(places, indices, axis, body);
}

void CellsOnRays::sweep(std::span<const glm::dvec3> places, std::span<const std::uint32_t> indices, int axis,
                        std::uint8_t body) {
    const glm::ivec3 size = turned(cells_, axis);
    const std::size_t most = mostCrossings(places, indices, axis, size);
    if (most == 0) return;
    reserve(crossings_, most * crossingBytes);
    counts_.clear();
    total_.clear();
    places_.bindStorage(0);
    indices_.bindStorage(1);
    counts_.bindStorage(2);
    firsts_.bindStorage(3);
    crossings_.bindStorage(4);
    total_.bindStorage(5);
    bodies_.bindStorage(6);
    const auto run = [](Kernel& kernel, int threads) {
        kernel.set("count", threads);
        kernel.runGroups((threads + group - 1) / group);
    };
    const int triangles = static_cast<int>(indices.size() / 3), rays = size.y * size.z;
    for (Kernel* kernel : {&countCrossings_, &storeCrossings_, &fillRays_}) {
        kernel->set("axis", axis);
        kernel->set("size", size);
    }
    fillRays_.set("body", static_cast<int>(body));
    run(countCrossings_, triangles);
    run(placeRays_, rays);
    run(storeCrossings_, triangles);
    run(fillRays_, rays);
}

void CellsOnRays::read(std::span<std::uint8_t> bodies) const {
    std::vector<std::uint32_t> words(bodies.size());
    bodies_.read(std::span<std::uint32_t>(words));
    std::ranges::transform(words, bodies.begin(), [](std::uint32_t word) { return static_cast<std::uint8_t>(word); });
}

std::size_t CellsOnRays::bytes() const {
    std::size_t bytes = 0;
    for (const gpu::Buffer* buffer : {&places_, &indices_, &counts_, &firsts_, &crossings_, &total_, &bodies_})
        bytes += buffer->bytes();
    return bytes;
}

}  // namespace dustbench::grid_fluid::flow_gl
