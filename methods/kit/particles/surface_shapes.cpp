#include "methods/kit/particles/surface_shapes.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/meshes/triangle_tree.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/scene_surface.h"

namespace dustbench::particles {
namespace {

/// d = n·(x − p): hit where d becomes negative. A particle that starts behind the plane and moves deeper is hit
/// immediately.
void meetHalfSpace(const Ways& ways, float* __restrict share, const glm::vec3 p, const glm::vec3 n) {
    for (std::size_t i = 0; i < ways.count; ++i) {
        const float before = n.x * (ways.fromX[i] - p.x) + n.y * (ways.fromY[i] - p.y) + n.z * (ways.fromZ[i] - p.z);
        const float after = n.x * (ways.toX[i] - p.x) + n.y * (ways.toY[i] - p.y) + n.z * (ways.toZ[i] - p.z);
        const float at = before > 0.0f ? before / (before - after) : 0.0f;
        const bool met = (after < 0.0f) & (after < before);
        share[i] = met ? at : Surface::none;
    }
}

/// |o + s·w|² = R² with o = from − c: the first root, s = (o·o − R²)/(−o·w + √((o·w)² − w·w·(o·o − R²))).
void meetSphere(const Ways& ways, float* __restrict share, const glm::vec3 c, const float radius) {
    for (std::size_t i = 0; i < ways.count; ++i) {
        const float ox = ways.fromX[i] - c.x, oy = ways.fromY[i] - c.y, oz = ways.fromZ[i] - c.z;
        const float wx = ways.toX[i] - ways.fromX[i], wy = ways.toY[i] - ways.fromY[i],
                    wz = ways.toZ[i] - ways.fromZ[i];
        const float towards = -(ox * wx + oy * wy + oz * wz);
        const float outside = ox * ox + oy * oy + oz * oz - radius * radius;
        const float root = towards * towards - (wx * wx + wy * wy + wz * wz) * outside;
        const float at = outside / (towards + std::sqrt(root > 0.0f ? root : 0.0f));
        const float first = outside > 0.0f ? at : 0.0f;  // inside and moving deeper: hit immediately
        const bool met = (towards > 0.0f) & (root >= 0.0f) & (first <= 1.0f);
        share[i] = met ? first : Surface::none;
    }
}

/// d = n·(x − c): hit where d changes sign within the radius.
void meetDisc(const Ways& ways, float* __restrict share, const glm::vec3 c, const glm::vec3 n, const float radius) {
    for (std::size_t i = 0; i < ways.count; ++i) {
        const float ox = ways.fromX[i] - c.x, oy = ways.fromY[i] - c.y, oz = ways.fromZ[i] - c.z;
        const float wx = ways.toX[i] - ways.fromX[i], wy = ways.toY[i] - ways.fromY[i],
                    wz = ways.toZ[i] - ways.fromZ[i];
        const float before = n.x * ox + n.y * oy + n.z * oz;
        const float after = n.x * (ways.toX[i] - c.x) + n.y * (ways.toY[i] - c.y) + n.z * (ways.toZ[i] - c.z);
        const bool crosses = ((before > 0.0f) & (after <= 0.0f)) | ((before < 0.0f) & (after >= 0.0f));
        const float at = before / (before - after);
        const float px = ox + at * wx, py = oy + at * wy, pz = oz + at * wz;
        const bool met = crosses & (px * px + py * py + pz * pz <= radius * radius);
        share[i] = met ? at : Surface::none;
    }
}

class HalfSpace final : public Surface {
 public:
    explicit HalfSpace(const SurfaceNumbers& n) : n_(n) {}
    void meet(const Ways& ways, float* share) const override { meetHalfSpace(ways, share, n_.place, n_.normal); }
    [[nodiscard]] Touch touchAt(const Meeting& m) const override { return {m.point(), n_.normal}; }
    [[nodiscard]] float extentMetres() const override { return sumOfSizes(n_.place); }

 private:
    SurfaceNumbers n_;
};

class Sphere final : public Surface {
 public:
    explicit Sphere(const SurfaceNumbers& n) : n_(n) {}
    void meet(const Ways& ways, float* share) const override { meetSphere(ways, share, n_.place, n_.radiusMetres); }
    [[nodiscard]] Touch touchAt(const Meeting& m) const override {
        const glm::vec3 out = m.point() - n_.place;
        const float length = glm::length(out);
        return {m.point(), length > 0 ? out / length : glm::vec3(0, 1, 0)};
    }
    [[nodiscard]] float extentMetres() const override { return sumOfSizes(n_.place) + n_.radiusMetres; }

 private:
    SurfaceNumbers n_;
};

class Disc final : public Surface {
 public:
    explicit Disc(const SurfaceNumbers& n) : n_(n) {}
    void meet(const Ways& ways, float* share) const override {
        meetDisc(ways, share, n_.place, n_.normal, n_.radiusMetres);
    }
    [[nodiscard]] Touch touchAt(const Meeting& m) const override {
        return {m.point(), glm::dot(n_.normal, m.from - n_.place) < 0 ? -n_.normal : n_.normal};
    }
    [[nodiscard]] float extentMetres() const override { return sumOfSizes(n_.place) + n_.radiusMetres; }

 private:
    SurfaceNumbers n_;
};

/// Passes only paths whose bounding box overlaps the mesh's to the tree.
class MeshSurface final : public Surface {
 public:
    MeshSurface(const ParameterValues& values, const glm::vec3& place) {
        scene::Mesh mesh;
        for (const auto& triangle : trianglesOf(values))
            for (const glm::vec3& corner : triangle) {
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
                mesh.positions.push_back(corner + place);
                minimum_ = glm::min(minimum_, corner + place);
                maximum_ = glm::max(maximum_, corner + place);
            }
        tree_.add(mesh, glm::mat4(1));
        tree_.build();
    }
    void meet(const Ways& ways, float* share) const override {
        for (std::size_t i = 0; i < ways.count; ++i) {
            const glm::vec3 from = ways.from(i), to = ways.to(i);
            const bool near = glm::all(glm::lessThanEqual(glm::min(from, to), maximum_)) &&
                              glm::all(glm::lessThanEqual(minimum_, glm::max(from, to)));
            const auto hit = near ? tree_.firstHit(from, to) : std::nullopt;
            share[i] = hit ? hit->share : none;
        }
    }
    [[nodiscard]] Touch touchAt(const Meeting& m) const override {
        const auto hit = tree_.firstHit(m.from, m.to);
        return {m.point(), hit ? hit->normal : glm::vec3(0, 1, 0)};
    }
    [[nodiscard]] float extentMetres() const override { return std::max(sumOfSizes(minimum_), sumOfSizes(maximum_)); }
    [[nodiscard]] std::size_t bytes() const override { return tree_.bytes(); }

 private:
    meshes::TriangleTree tree_;
    glm::vec3 minimum_{INFINITY}, maximum_{-INFINITY};
};

}  // namespace

void declareSurface(ParameterSet& set) {
    set.choice("shape", SurfaceShape::halfSpace, surfaceShapes,
               "the surface; scene: the scene's ground, solids and moving vehicle");
    declareVector(set, "place", spaceAxes, {0, 0, 0}, -1e6, 1e6, "m",
                  "a point on the half-space's plane, the centre of sphere or disc, the origin of the mesh");
    declareVector(set, "normal", spaceAxes, {0, 1, 0}, -1, 1, "", "normal of half-space or disc, outwards");
    set.real("radius_metres", 1, 1e-3, 1e5, "m", "radius of sphere or disc");
    declareMesh(set);
    set.boolean("on_ground", true, "for a scene: includes its ground")
        .boolean("on_solids", true, "for a scene: includes its solids")
        .boolean("on_vehicle", true, "for a scene: includes the vehicle and its wheels");
    declareMark(set, "a sphere or a disc; of a half-space the disc of its radius; others are not drawn",
                {0.5, 0.5, 0.5});
}

SurfaceNumbers surfaceNumbers(const ParameterValues& values) {
    return {values.choice("shape", surfaceShapes), vectorOf(values, "place", spaceAxes), directionOf(values, "normal"),
            static_cast<float>(values.real("radius_metres"))};
}

std::optional<Mark> markOfSurface(const ParameterValues& values) {
    const SurfaceNumbers s = surfaceNumbers(values);
    if (s.shape == SurfaceShape::mesh || s.shape == SurfaceShape::scene) return std::nullopt;
    const MarkShape shape = s.shape == SurfaceShape::sphere ? MarkShape::ball : MarkShape::disc;
    return markOf(values, {shape, s.place, s.normal, s.radiusMetres});
}

std::unique_ptr<Surface> makeBall(const glm::vec3& centre, float radiusMetres) {
    return std::make_unique<Sphere>(SurfaceNumbers{SurfaceShape::sphere, centre, {0, 1, 0}, radiusMetres});
}

std::unique_ptr<Surface> makeSurface(const ParameterValues& values) {
    const SurfaceNumbers numbers = surfaceNumbers(values);
    switch (numbers.shape) {
        case SurfaceShape::halfSpace:
            return std::make_unique<HalfSpace>(numbers);
        case SurfaceShape::sphere:
            return std::make_unique<Sphere>(numbers);
        case SurfaceShape::disc:
            return std::make_unique<Disc>(numbers);
        case SurfaceShape::scene:
            return std::make_unique<SceneSurface>(
                SceneParts{values.boolean("on_ground"), values.boolean("on_solids"), values.boolean("on_vehicle")});
        case SurfaceShape::mesh:
            break;
    }
    return std::make_unique<MeshSurface>(values, numbers.place);
}

}  // namespace dustbench::particles
