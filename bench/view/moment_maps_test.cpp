#include "bench/view/moment_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bench/measure/image/flaw_metrics.h"
#include "bench/reference/camera_rays.h"
#include "bench/reference/judge/moment_pictures.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::view {
namespace {

constexpr int width = 160, height = 120;

scene::View randomView(std::mt19937& random) {
    std::uniform_real_distribution<double> upTo(-1, 1);
    scene::View view;
    view.camera.eye = {9 * upTo(random), 4 + 3 * upTo(random), 12 + 2 * upTo(random)};
    view.camera.target = {upTo(random), upTo(random), upTo(random)};
    view.width = width;
    view.height = height;
    return view;
}

exports::CollectedVolume puffAt(const glm::vec3& centre, float radiusMetres) {
    MemoryLedger ledger;
    particles::ParticleStore store(ledger);
    store.resize(1);
    store.serial[0] = 7;
    store.x[0] = centre.x, store.y[0] = centre.y, store.z[0] = centre.z;
    store.radius[0] = radiusMetres;
    store.opacity[0] = 0.5f;
    exports::CollectedVolume volume;
    volume.puffs(store);
    return volume;
}

/// In a world of 8 m around the origin.
exports::CollectedVolume voxelAt(const glm::uvec3& cell, int level) {
    const std::vector voxels{OctreeVoxel{cell.x, cell.y, cell.z, level, 1.0f, 0.0f}};
    exports::CollectedVolume volume;
    volume.octree({glm::dvec3(-4), 8, 5, voxels});
    return volume;
}

/// A pixel of the plane that is not 0 lies at most `reach` away.
bool hasNear(const measure::Plane& plane, int x, int y, int reach) {
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, plane.height - 1); ++j)
        for (int i = std::max(x - reach, 0); i <= std::min(x + reach, plane.width - 1); ++i)
            if (plane.at(i, j) > 0) return true;
    return false;
}

/// 1 where the value differs from that of a neighbour to the right or below.
measure::Plane borderOf(const measure::Plane& map) {
    measure::Plane border(map.width, map.height);
    for (int y = 0; y + 1 < map.height; ++y)
        for (int x = 0; x + 1 < map.width; ++x)
            border.at(x, y) = map.at(x, y) != map.at(x + 1, y) || map.at(x, y) != map.at(x, y + 1);
    return border;
}

TEST(Outlines, OfAQuadAreTheBorderOfWhatOverdrawFills) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> upTo(-1, 1);
    int found = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const scene::View view = randomView(random);
        const exports::CollectedVolume puff =
            puffAt({5 * upTo(random), 3 * upTo(random), 5 * upTo(random)}, 0.4f + 0.3f * upTo(random));
        const measure::Plane border =
            borderOf(measure::overdrawMap(reference::primitivesOnScreen(puff, view), width, height));
        const Outlines outlines = outlinesOf(puff, view);
        EXPECT_EQ(std::ranges::max(outlines.voxels.values), 0);
        for (int y = 1; y + 2 < height; ++y)
            for (int x = 1; x + 2 < width; ++x) {
                if (outlines.quads.at(x, y) > 0) {
                    EXPECT_TRUE(hasNear(border, x, y, 1)) << trial << ": " << x << ' ' << y;
                    ++found;
                }
                if (border.at(x, y) > 0) {
                    EXPECT_TRUE(hasNear(outlines.quads, x, y, 1)) << trial;
                }
            }
    }
    EXPECT_GT(found, 2000);
}

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const double share = glm::dot(b - a, b - a) > 0 ? glm::dot(p - a, b - a) / glm::dot(b - a, b - a) : 0;
    return glm::distance(p, glm::mix(a, b, std::clamp(share, 0.0, 1.0)));
}

TEST(Outlines, OfAVoxelAreItsTwelveEdges) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 60; ++trial) {
        const scene::View view = randomView(random);
        const reference::CameraRays rays(view);
        const int level = 3;
        const glm::uvec3 cell(random() % 8, random() % 8, random() % 8);
        const measure::Plane drawn = outlinesOf(voxelAt(cell, level), view).voxels;
        std::vector<std::pair<glm::dvec2, glm::dvec2>> edges;
        const auto pixel = [&](const glm::dvec3& corner) {
            const glm::dvec3 place = rays.fromWorld(glm::dvec3(-4) + glm::dvec3(cell) + corner);
            return glm::dvec2(rays.pixelX(place.x / place.z), rays.pixelY(place.y / place.z));
        };
        for (int axis = 0; axis < 3; ++axis)
            for (const glm::dvec2 other : {glm::dvec2(0, 0), glm::dvec2(0, 1), glm::dvec2(1, 0), glm::dvec2(1, 1)}) {
                glm::dvec3 from(0), to(0);
                from[axis] = 0, to[axis] = 1;
                from[(axis + 1) % 3] = to[(axis + 1) % 3] = other.x;
                from[(axis + 2) % 3] = to[(axis + 2) % 3] = other.y;
                edges.emplace_back(pixel(from), pixel(to));
            }
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (drawn.at(x, y) > 0) {
                    EXPECT_TRUE(std::ranges::any_of(edges, [&](const auto& edge) {
                        return distanceToSegment({x + 0.5, y + 0.5}, edge.first, edge.second) < 1;
                    })) << trial;
                }
        for (const auto& [from, to] : edges)
            for (double share = 0.05; share < 1; share += 0.1) {
                const glm::ivec2 at(glm::floor(glm::mix(from, to, share)));
                if (at.x < 1 || at.y < 1 || at.x >= width - 1 || at.y >= height - 1) continue;
                EXPECT_TRUE(hasNear(drawn, at.x, at.y, 1)) << trial;
            }
    }
}

TEST(Outlines, EndBeforeTheEye) {
    scene::View view;
    view.width = width;
    view.height = height;
    for (const glm::dvec3 eye : {glm::dvec3(0.1, 0.1, 0.1), glm::dvec3(0, 0, 0), glm::dvec3(3.9, 1, 2)}) {
        view.camera.eye = eye;
        view.camera.target = eye + glm::dvec3(0.3, 0.1, -1);
        for (unsigned cell = 0; cell < 4; ++cell) {
            const Outlines outlines = outlinesOf(voxelAt(glm::uvec3(cell, 2, 2), 2), view);
            for (const float count : outlines.voxels.values) EXPECT_TRUE(count >= 0 && count <= 24);
        }
        EXPECT_EQ(std::ranges::max(outlinesOf(puffAt(glm::vec3(eye) + glm::vec3(0, 0, 3), 1), view).quads.values), 0);
    }
}

TEST(Outlines, OfWhatLiesBehindTheEyeAreNone) {
    scene::View view;
    view.width = width;
    view.height = height;
    view.camera.eye = glm::dvec3(0.1);
    view.camera.target = view.camera.eye + glm::dvec3(0.3, 0.1, -1);
    for (unsigned x = 0; x < 4; ++x)
        for (unsigned y = 0; y < 4; ++y) {
            const Outlines outlines = outlinesOf(voxelAt(glm::uvec3(x, y, 3), 2), view);  // from z = 2 m
            EXPECT_EQ(std::ranges::max(outlines.voxels.values), 0) << x << ' ' << y;
        }
}

TEST(Outlines, LieOverTheDarkenedPicture) {
    const pictures::Image picture{3, 1, std::vector<glm::vec4>(3, glm::vec4(0.5f, 0.4f, 0.3f, 1))};
    Outlines outlines{measure::Plane(3, 1), measure::Plane(3, 1)};
    outlines.quads.values = {0, 1, 0};
    outlines.voxels.values = {0, 0, 9};
    const pictures::Image drawn = withOutlines(picture, outlines);
    for (int channel = 0; channel < 3; ++channel) EXPECT_LT(drawn.pixels[0][channel], picture.pixels[0][channel]);
    EXPECT_GT(drawn.pixels[1].r, drawn.pixels[1].b);
    EXPECT_GT(drawn.pixels[2].b, 0.8f);
    EXPECT_THROW((void)withOutlines(picture, {measure::Plane(2, 1), measure::Plane(2, 1)}), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::view
