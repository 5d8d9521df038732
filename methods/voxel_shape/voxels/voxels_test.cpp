#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/voxel_shape/voxels/slice_pass.h"
#include "methods/voxel_shape/voxels/solid_fill.h"
#include "methods/voxel_shape/voxels/solid_space.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {
namespace {

gpu::Device& device() {
    static gpu::Device one;
    return one;
}

scene::Mesh builtIn(const char* file) {
    return meshes::readMesh(files::dataFolder() / "scenes" / "meshes" / file, {0.4f, 0.3f, 0.2f});
}

struct Overlap {
    std::size_t both = 0, either = 0, onlyFirst = 0;
};
Overlap overlapOf(const MarkedVoxels& a, const MarkedVoxels& b) {
    Overlap overlap;
    for (std::size_t i = 0; i < a.marked.size(); ++i) {
        overlap.both += a.marked[i] && b.marked[i];
        overlap.either += a.marked[i] || b.marked[i];
        overlap.onlyFirst += a.marked[i] && !b.marked[i];
    }
    return overlap;
}

double solidVolume(float radius, int resolution) {
    const scene::Mesh sphere = sphereMesh(radius, 90);
    MarkedVoxels solid = surfaceVoxels(sphere, latticeAround(sphere, resolution));
    fillSolid(solid, sphere);
    return static_cast<double>(solid.count()) * std::pow(static_cast<double>(solid.lattice.edgeMetres), 3);
}

TEST(SurfaceVoxels, MissNoPointOfTheSurface) {
    const scene::Mesh rock = builtIn("rock.obj");
    const MarkedVoxels voxels = surfaceVoxels(rock, latticeAround(rock, 60));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int sample = 0; sample < 20'000; ++sample) {
        const std::size_t t = random() % (rock.indices.size() / 3) * 3;
        float u = unit(random), v = unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const glm::vec3 a = rock.positions[rock.indices[t]], b = rock.positions[rock.indices[t + 1]],
                        c = rock.positions[rock.indices[t + 2]];
        const glm::ivec3 cell(glm::floor(voxels.lattice.toVoxels(a + u * (b - a) + v * (c - a))));
        ASSERT_TRUE(voxels.lattice.contains(cell));
        ASSERT_TRUE(voxels.marked[voxels.lattice.index(cell)]);
    }
}

TEST(SurfaceVoxels, MarkNothingThatTheSurfaceStaysAwayFrom) {
    const scene::Mesh sphere = sphereMesh(1, 60);
    const MarkedVoxels voxels = surfaceVoxels(sphere, latticeAround(sphere, 40));
    const float reach =
        voxels.lattice.edgeMetres * std::sqrt(3.0f) / 2 + 2e-3f;  // half a diagonal plus the sag of the facets
    for (std::uint32_t i = 0; i < voxels.marked.size(); ++i) {
        const float away = std::abs(glm::length(voxels.lattice.centre(voxels.lattice.cell(i))) - 1);
        ASSERT_TRUE(!voxels.marked[i] || away <= reach) << away;
    }
    // A slanted triangle leaves most of its bounding box unmarked.
    scene::Mesh slanted;
    slanted.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.001f}};
    slanted.indices = {0, 1, 2};
    const MarkedVoxels half = surfaceVoxels(slanted, latticeAround(slanted, 32));
    EXPECT_NEAR(static_cast<double>(half.count()), 32 * 33 / 2.0, 33);
}

TEST(SurfaceVoxels, TakeTheColourOfTheSurfaceInThem) {
    const scene::Mesh sphere = sphereMesh(1, 60);
    const MarkedVoxels voxels = surfaceVoxels(sphere, latticeAround(sphere, 40));
    for (std::uint32_t i = 0; i < voxels.marked.size(); ++i) {
        if (!voxels.marked[i]) continue;
        const float share = 0.5f + 0.5f * voxels.lattice.centre(voxels.lattice.cell(i)).x;
        ASSERT_NEAR(voxels.colours[i].b, share, 0.03f);
        ASSERT_NEAR(voxels.colours[i].r, 1 - share, 0.03f);
    }
}

TEST(Slices, OfTheGpuLieInTheConservativeSetAndAgreeWithTheirCopyOnTheCpu) {
    const std::pair<const char*, scene::Mesh> meshes[]{
        {"rock", builtIn("rock.obj")}, {"crate", builtIn("crate.ply")}, {"sphere", sphereMesh(0.7f, 48)}};
    for (const auto& [name, mesh] : meshes) {
        const Lattice lattice = latticeAround(mesh, 50);
        const MarkedVoxels drawn = slicePass(device(), mesh, lattice);
        const MarkedVoxels copy = sliceVoxels(mesh, lattice);
        const MarkedVoxels whole = surfaceVoxels(mesh, lattice);
        const Overlap both = overlapOf(drawn, copy), missed = overlapOf(whole, drawn);
        EXPECT_EQ(overlapOf(drawn, whole).onlyFirst, 0u) << name;
        EXPECT_GE(static_cast<double>(both.both) / static_cast<double>(both.either), 0.99) << name;
        // The error of the paper's algorithm: parts that are edge-on or between the pixel centres.
        const double share = static_cast<double>(missed.onlyFirst) / static_cast<double>(whole.count());
        ::testing::Test::RecordProperty(std::string("missed_by_slices_") + name, std::to_string(share));
        EXPECT_GT(share, 0) << name;
        EXPECT_LT(share, 0.8) << name;
        // Along all three axes fewer voxels are missed, and still none is marked wrongly.
        const MarkedVoxels three = slicesAlongAllAxes(device(), mesh, lattice);
        EXPECT_EQ(overlapOf(three, whole).onlyFirst, 0u) << name;
        EXPECT_EQ(overlapOf(drawn, three).onlyFirst, 0u) << name;
        EXPECT_GT(three.count(), drawn.count() * 5 / 4) << name;
        std::size_t sameColour = 0;
        for (std::size_t i = 0; i < copy.marked.size(); ++i)
            sameColour += copy.marked[i] && drawn.marked[i] && glm::distance(copy.colours[i], drawn.colours[i]) < 0.02f;
        EXPECT_GE(static_cast<double>(sameColour), 0.98 * static_cast<double>(both.both)) << name;
    }
}

TEST(Slices, FindAModelInTheColourOfTheBackground) {
    scene::Mesh sphere = sphereMesh(1, 24);
    const Lattice lattice = latticeAround(sphere, 20);
    const std::size_t expected = slicePass(device(), sphere, lattice).count();
    const glm::vec3 grey(0.25f);
    sphere.colours.assign(sphere.positions.size(), grey);
    EXPECT_GT(expected, 500u);
    EXPECT_EQ(slicePass(device(), sphere, lattice, grey).count(), expected);
}

TEST(SolidFill, ConvergesToTheVolumeOfASphere) {
    const double radius = 1, volume = 4.0 / 3 * glm::pi<double>() * std::pow(radius, 3);
    const double coarse = std::abs(solidVolume(1, 16) / volume - 1), fine = std::abs(solidVolume(1, 64) / volume - 1);
    EXPECT_LT(fine, 0.1);
    EXPECT_GE(std::log2(coarse / fine) / 2, 0.95) << "order of convergence: " << coarse << " to " << fine;
}

TEST(SolidFill, RefusesAnOpenSurfaceThatEnclosesNothing) {
    const scene::Mesh wall = rectangleMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(meshes::openEdges(wall), 4u);
    EXPECT_EQ(meshes::openEdges(sphereMesh(1, 12)), 0u);
    MarkedVoxels voxels = surfaceVoxels(wall, latticeAround(wall, 8));
    EXPECT_EQ(voxels.count(), 64u);
    EXPECT_NE(inputError([&] { fillSolid(voxels, wall); }).find("encloses nothing"), std::string::npos);

    // A hole narrower than a voxel does not matter.
    scene::Mesh holed = sphereMesh(1, 60);
    holed.indices.resize(holed.indices.size() - 3);
    MarkedVoxels solid = surfaceVoxels(holed, latticeAround(holed, 12));
    const std::size_t surface = solid.count();
    fillSolid(solid, holed);
    EXPECT_GT(solid.count(), surface + 300);
}

TEST(SolidFill, MarksWhatNoWayLeadsToFromOutside) {
    std::mt19937 random(5);
    for (const glm::ivec3 counts : {glm::ivec3(1), glm::ivec3(17, 9, 12), glm::ivec3(5, 31, 3)})
        for (const double share : {0.0, 0.3, 0.45, 0.6, 1.0}) {
            MarkedVoxels maze(Lattice{counts, glm::vec3(0), 1});
            std::bernoulli_distribution isWall(share);
            for (std::uint8_t& marked : maze.marked) marked = isWall(random) ? 1 : 0;
            // Reference: flood fill from each reached cell to its neighbours, one at a time.
            std::vector<std::uint8_t> inside(maze.marked.size(), 1);
            std::vector<glm::ivec3> reached;
            const auto reach = [&](const glm::ivec3& cell) {
                if (!maze.lattice.contains(cell)) return;
                const std::uint32_t i = maze.lattice.index(cell);
                if (maze.marked[i] || !inside[i]) return;
                inside[i] = 0;
                reached.push_back(cell);
            };
            for (std::uint32_t i = 0; i < inside.size(); ++i) {
                const glm::ivec3 cell = maze.lattice.cell(i);
                if (glm::any(glm::equal(cell, glm::ivec3(0))) || glm::any(glm::equal(cell, counts - 1))) reach(cell);
            }
            while (!reached.empty()) {
                const glm::ivec3 from = reached.back();
                reached.pop_back();
                for (int axis = 0; axis < 3; ++axis)
                    for (const int way : {-1, 1}) {
                        glm::ivec3 to = from;
                        to[axis] += way;
                        reach(to);
                    }
            }
            const bool any = inside != maze.marked;
            EXPECT_EQ(markInside(maze), any);
            EXPECT_EQ(maze.marked, inside) << counts.x << " share " << share;
        }
}

TEST(Lattice, HoldsTheMeshAtEveryResolution) {
    const scene::Mesh sphere = sphereMesh(3, 10);
    for (const int resolution : {1, 2, 50, 256}) {
        const Lattice lattice = latticeAround(sphere, resolution);
        EXPECT_EQ(lattice.counts, glm::ivec3(resolution));
        for (const glm::vec3& position : sphere.positions)
            ASSERT_TRUE(lattice.contains(glm::ivec3(glm::floor(lattice.toVoxels(position)))));
    }
    EXPECT_EQ(latticeAround(rectangleMesh({0, 0, 0}, {4, 0, 0}, {0, 1, 0}), 8).counts, glm::ivec3(8, 3, 1));
}

TEST(Lattice, SaysWhatIsWrongWithAMesh) {
    const auto message = [](const scene::Mesh& mesh, int resolution) {
        return inputError([&] { (void)latticeAround(mesh, resolution); });
    };
    scene::Mesh mesh = sphereMesh(1, 6);
    EXPECT_NE(message(mesh, 0).find("got 0, allowed: 1..256"), std::string::npos);
    EXPECT_NE(message(mesh, 257).find("got 257, allowed: 1..256"), std::string::npos);
    EXPECT_NE(message({}, 8).find("without triangles"), std::string::npos);
    mesh.positions[3].y = NAN;
    EXPECT_NE(message(mesh, 8).find("vertex 3 is not a finite point"), std::string::npos);
    mesh = sphereMesh(1, 6);
    mesh.indices[4] = 10'000;
    EXPECT_NE(message(mesh, 8).find("uses vertex 10000"), std::string::npos);
    mesh = rectangleMesh({1, 2, 3}, {0, 0, 0}, {0, 0, 0});
    EXPECT_NE(message(mesh, 8).find("longest side is 0"), std::string::npos);
    // Degenerate triangles are valid.
    mesh = rectangleMesh({0, 0, 0}, {1, 1, 1}, {0, 0, 0});
    EXPECT_GE(surfaceVoxels(mesh, latticeAround(mesh, 8)).count(), 8u);
}

TEST(VoxelGrid, SharesParticlesOutEvenly) {
    const scene::Mesh sphere = sphereMesh(1, 12);
    MemoryLedger ledger;
    VoxelGrid grid(ledger, surfaceVoxels(sphere, latticeAround(sphere, 10)), Voxel());
    for (const std::uint32_t particles : {0u, 7u, 30'000u}) {
        grid.shareOut(particles);
        std::uint64_t sum = 0;
        for (const std::uint32_t i : grid.active()) {
            const auto fair = static_cast<double>(particles) / static_cast<double>(grid.active().size());
            EXPECT_NEAR(static_cast<double>(grid.voxels()[i].maximumDensity), fair, 1);
            sum += grid.voxels()[i].maximumDensity;
        }
        EXPECT_EQ(sum, particles);
    }
    EXPECT_EQ(ledger.account("voxels").bytes(), 64 * grid.lattice().size());
}

TEST(VoxelNormals, OfASphereLookAwayFromItsMiddle) {
    MemoryLedger ledger;
    const scene::Mesh sphere = sphereMesh(1, 40);
    for (const int resolution : {16, 30, 60}) {
        const VoxelGrid grid(ledger, surfaceVoxels(sphere, latticeAround(sphere, resolution)), Voxel());
        const std::vector<glm::vec3> normals = normalsOf(grid);
        double sum = 0;
        for (std::size_t k = 0; k < normals.size(); ++k) {
            const glm::vec3 radial = glm::normalize(grid.lattice().centre(grid.lattice().cell(grid.active()[k])));
            EXPECT_GT(glm::dot(normals[k], radial), 0.7f) << "within 45 degrees";
            sum += static_cast<double>(glm::dot(normals[k], radial));
        }
        EXPECT_GT(sum / static_cast<double>(normals.size()), 0.96) << "within 16 degrees on average";
    }
}

TEST(VoxelNormals, AreNoneWhereMatterIsTheSameOnAllSides) {
    MemoryLedger ledger;
    MarkedVoxels marked(Lattice{{1, 1, 1}, glm::vec3(0), 1});
    marked.marked[0] = 1;
    EXPECT_EQ(normalsOf(VoxelGrid(ledger, marked, Voxel()))[0], glm::vec3(0));
}

/// A cube of edge 2 around the origin, counter-clockwise as seen from outside.
scene::Mesh cube() {
    scene::Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back(corner & 4 ? 1 : -1, corner & 2 ? 1 : -1, corner & 1 ? 1 : -1);
    mesh.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                    2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    return mesh;
}

TEST(SolidSpace, IsWhatLiesWithinASolidWhereverItStands) {
    scene::Scene scene;
    scene::SolidPose pose;
    pose.toWorld = glm::rotate(glm::translate(glm::mat4(1), {5, 1, 0}), 0.6f, {0.6f, 0.8f, 0});
    scene.solids = {{"here", std::make_shared<scene::Mesh>(cube())}, {"there", std::make_shared<scene::Mesh>(cube())}};
    scene.solidPoses = {scene::SolidPose(), pose};
    const SolidSpace space(scene);
    const glm::dmat4 toThere = glm::inverse(glm::dmat4(pose.toWorld));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> along(-2.5, 8);
    int within = 0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 point(along(random), along(random) / 2, along(random) / 2);
        const auto inCube = [](const glm::dvec3& p) { return glm::all(glm::lessThan(glm::abs(p), glm::dvec3(1))); };
        const bool expected = inCube(point) || inCube(glm::dvec3(toThere * glm::dvec4(point, 1)));
        ASSERT_EQ(space.contains(point), expected) << point.x << ' ' << point.y << ' ' << point.z;
        within += expected;
    }
    EXPECT_GT(within, 500);
}

/// The rows of a grid of 16³ with these active voxels.
std::vector<glm::vec3> rowsAt(const std::vector<glm::ivec3>& cells) {
    static MemoryLedger ledger;
    MarkedVoxels marked(Lattice{glm::ivec3(16), glm::vec3(0), 0.1f});
    for (const glm::ivec3& cell : cells) marked.marked[marked.lattice.index(cell)] = 1;
    return rowsOf(VoxelGrid(ledger, marked, Voxel()));
}

TEST(Rows, AreFoundAlongEveryDirectionAndOnlyWhereOneVoxelIsBesideNoOther) {
    for (const glm::ivec3 along : {glm::ivec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 1}}) {
        std::vector<glm::ivec3> cells;
        for (int i = -5; i <= 5; ++i) cells.push_back(glm::ivec3(8) + i * along);
        for (const glm::vec3& row : rowsAt(cells))
            EXPECT_GT(std::abs(glm::dot(row, glm::normalize(glm::vec3(along)))), 0.999f)
                << along.x << along.y << along.z;
    }
    std::vector<glm::ivec3> slanted, wide, twoRows;
    for (int i = 0; i < 12; ++i) {
        slanted.emplace_back(i, i / 3, 5);
        for (int across = 0; across < 3; ++across) wide.emplace_back(i, across, 5);
        twoRows.emplace_back(i, 4, 5);
        twoRows.emplace_back(i, 7, 5);  // near, but it does not touch the other
    }
    for (const glm::vec3& row : rowsAt(slanted)) EXPECT_GT(row.x, 0.9f);
    for (const glm::vec3& row : rowsAt(wide)) EXPECT_EQ(row, glm::vec3(0));
    for (const glm::vec3& row : rowsAt(twoRows)) EXPECT_GT(row.x, 0.999f);
    EXPECT_EQ(rowsAt({{3, 3, 3}}).front(), glm::vec3(0));
}

}  // namespace
}  // namespace dustbench::voxel_shape
