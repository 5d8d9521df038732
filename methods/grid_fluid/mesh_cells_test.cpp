#include "methods/grid_fluid/mesh_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "methods/grid_fluid/test_bodies.h"

namespace dustbench::grid_fluid {
namespace {

std::size_t filled(const MeshCells& cells, std::uint8_t body) {
    return static_cast<std::size_t>(std::ranges::count(cells.bodies(), body));
}

TEST(MeshCells, FillABallByItsVolumeAndNothingBeside) {
    MemoryLedger ledger;
    MeshCells cells({40, 36, 32}, ledger.account("cells"));
    cells.add(ball(24), placed({20.3, 17.9, 16.1}, 10), 3);
    EXPECT_NEAR(static_cast<double>(filled(cells, 3)), 4.0 / 3 * std::numbers::pi * 1000, 60);
    std::size_t at = 0;
    for (int k = 0; k < 32; ++k)
        for (int j = 0; j < 36; ++j)
            for (int i = 0; i < 40; ++i, ++at) {
                const double distance = glm::distance(glm::dvec3(i, j, k) + 0.5, glm::dvec3(20.3, 17.9, 16.1));
                const bool inside = cells.bodies()[at] == 3;
                EXPECT_TRUE(distance > 9.8 || inside);
                EXPECT_TRUE(distance < 10 || !inside);
            }
    // The box cuts the ball in half, where the rays enter or where they leave.
    for (const double x : {0.0, 40.0}) {
        cells.clear();
        cells.add(ball(24), placed({x, 18, 16}, 10), 1);
        EXPECT_NEAR(static_cast<double>(filled(cells, 1)), 2.0 / 3 * std::numbers::pi * 1000, 40);
    }
    cells.clear();
    cells.add(ball(8), placed({20, -11, 16}, 10), 1);
    EXPECT_EQ(filled(cells, 1), 0u);
}

TEST(MeshCells, TakeOverlapsAndOpenPanels) {
    MemoryLedger ledger;
    MeshCells cells({40, 24, 24}, ledger.account("cells"));
    scene::Mesh mesh;
    mesh.append(ball(16), glm::mat4(placed({14, 12, 12}, 8)));
    mesh.append(ball(16), glm::mat4(placed({24, 12, 12}, 8)));
    MeshCells one({40, 24, 24}, ledger.account("cells")), other({40, 24, 24}, ledger.account("cells"));
    one.add(ball(16), placed({14, 12, 12}, 8), 1);
    other.add(ball(16), placed({24, 12, 12}, 8), 1);
    // Lamps: a panel in front of each end, facing outwards.
    for (const float x : {5.9f, 32.1f}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& corner : {glm::vec3(x, 10, 10), {x, 14, 10}, {x, 14, 14}, {x, 10, 14}})
            mesh.positions.push_back(corner);
        for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + index);
        if (x < 20) std::swap(mesh.indices[mesh.indices.size() - 2], mesh.indices[mesh.indices.size() - 1]);
        if (x < 20) std::swap(mesh.indices[mesh.indices.size() - 5], mesh.indices[mesh.indices.size() - 4]);
    }
    cells.add(mesh, glm::dmat4(1), 1);
    for (std::size_t at = 0; at < cells.bodies().size(); ++at)
        EXPECT_EQ(cells.bodies()[at], one.bodies()[at] | other.bodies()[at]) << at;
}

/// Cells that can be reached from the first cell through faces, without entering a body.
std::size_t reached(const MeshCells& cells) {
    const glm::ivec3 size = cells.cells();
    const auto at = [&](const glm::ivec3& cell) {
        return static_cast<std::size_t>(cell.x + size.x * (cell.y + size.y * cell.z));
    };
    std::vector<bool> seen(cells.bodies().size());
    std::vector<glm::ivec3> open{glm::ivec3(0)};
    std::size_t count = 0;
    while (!open.empty()) {
        const glm::ivec3 cell = open.back();
        open.pop_back();
        if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, size)) ||
            seen[at(cell)] || cells.bodies()[at(cell)] != 0)
            continue;
        seen[at(cell)] = true;
        ++count;
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = cell;
                next[axis] += step;
                open.push_back(next);
            }
    }
    return count;
}

TEST(MeshCells, ASmoothRimTakesNoCellBesideIt) {
    MemoryLedger ledger;
    MeshCells cells({8, 8, 8}, ledger.account("cells"));
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> place(3, 5);
    for (int n = 0; n < 100; ++n) {
        const glm::dvec3 middle(place(engine), place(engine), place(engine));
        cells.clear();
        cells.add(ball(24), placed(middle, 2), 1);
        std::size_t at = 0;
        for (int k = 0; k < 8; ++k)
            for (int j = 0; j < 8; ++j)
                for (int i = 0; i < 8; ++i, ++at)
                    EXPECT_TRUE(cells.bodies()[at] == 0 || glm::distance(glm::dvec3(i, j, k) + 0.5, middle) < 2);
    }
}

TEST(MeshCells, NoPathLeadsThroughAWallHoweverThin) {
    MemoryLedger ledger;
    constexpr glm::ivec3 size{24, 20, 22};
    MeshCells cells(size, ledger.account("cells"));
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> share(-1, 1);
    const auto vector = [&] { return glm::dvec3(share(engine), share(engine), share(engine)); };
    for (int n = 0; n < 300; ++n) {
        const glm::dvec3 middle = glm::dvec3(size) / 2.0 + 3.0 * vector();
        const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1), middle), 3 * share(engine), vector());
        const double thickness = std::array{0.01, 0.1, 0.7}[static_cast<std::size_t>(n % 3)];
        cells.clear();
        cells.add(block(glm::vec3(1)), glm::scale(turned, glm::dvec3(thickness, 80, 80)), 1);
        if (cells.bodies()[0] != 0) continue;
        // Free cells on the side of the first one.
        std::size_t near = 0, at = 0;
        const auto side = [&](const glm::dvec3& place) { return glm::dot(place - middle, glm::dvec3(turned[0])) > 0; };
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i, ++at)
                    if (cells.bodies()[at] == 0 && side(glm::dvec3(i, j, k) + 0.5) == side(glm::dvec3(0.5))) ++near;
        EXPECT_LE(reached(cells), near) << "a path leads through wall " << n;
        EXPECT_GE(reached(cells) + 40, near) << "wall " << n << " closes off cells that it does not touch";
        EXPECT_LE(filled(cells, 1), 2u * 24 * 22) << "wall " << n << " is more than two cells thick";
    }
}

}  // namespace
}  // namespace dustbench::grid_fluid
