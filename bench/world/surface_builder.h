// Builds a mesh from curved patches, boxes and surfaces of revolution, each with its own colours.
//
// Owns: the mesh under construction.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::world {

class SurfaceBuilder {
 public:
    using Position = std::function<glm::vec3(float u, float v)>;
    using Colour = std::function<glm::vec3(float u, float v)>;

    /// The quads between the lines `us` and `vs` of the surface P(u, v), one colour per cell (taken at its centre). The
    /// outside is the direction of ∂P/∂u × ∂P/∂v; normals are those of the smooth surface.
    void patch(std::span<const float> us, std::span<const float> vs, const Position& position, const Colour& colour);
    /// The same with one flat normal per cell.
    void facets(std::span<const float> us, std::span<const float> vs, const Position& position, const Colour& colour);
    /// The same with explicit normals.
    void patch(std::span<const float> us, std::span<const float> vs, const Position& position, const Position& normal,
               const Colour& colour);
    void box(const glm::vec3& centre, const glm::vec3& halfSize, const glm::vec3& colour);
    /// A profile of (radius, z), revolved about the Z axis; the outside is to the left of its direction, seen with the
    /// radius to the right and z upwards. Each segment between two points has its own normal and colour.
    void turned(std::span<const glm::vec2> profile, int segments,
                const std::function<glm::vec3(int part, int segment)>& colour);
    /// A disc with a rim behind it, used for lamps. Faces `+X` or `−X`.
    void lamp(const glm::vec3& centre, float radius, float depth, bool forwards, const glm::vec3& glass,
              const glm::vec3& rim);

    /// Appends the mirror image in the plane z = 0 of all triangles from `firstVertex`, `firstIndex` on.
    void mirror(std::size_t firstVertex, std::size_t firstIndex);

    [[nodiscard]] std::size_t vertices() const { return mesh_.positions.size(); }
    [[nodiscard]] std::size_t indices() const { return mesh_.indices.size(); }
    [[nodiscard]] scene::Mesh finish() { return std::move(mesh_); }

 private:
    void quad(const glm::vec3 (&corners)[4], const glm::vec3 (&normals)[4], const glm::vec3& colour);

    scene::Mesh mesh_;
};

/// Evenly spaced values from `first` to `last`.
[[nodiscard]] std::vector<float> lines(float first, float last, int cells);

}  // namespace dustbench::world
