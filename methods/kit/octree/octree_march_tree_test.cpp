#include "methods/kit/octree/octree_march.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "methods/kit/octree/octree_march_test_tree.h"

namespace dustbench::octree {
namespace {

TEST(OctreeMarchTree, SumsFromTheRootDownAndBoundsTheVoxels) {
    TestTree tree({glm::dvec3(0), 16, 4});
    tree.add({{1, 0, 1}, 1, 2, {1, 0, 0}});
    tree.add({{5, 1, 6}, 3, 6, {0, 1, 0}});
    OctreeMarchTree made;
    made.set(tree.marched(true));
    EXPECT_EQ(made.minimum(), glm::ivec3(8, 0, 8));
    EXPECT_EQ(made.maximum(), glm::ivec3(16, 8, 16));
    ASSERT_EQ(made.slots().size(), 24u);
    constexpr float scale = -1.44269504f;  // a finest cell has an edge of 1 m
    for (std::size_t slot = 0; slot < 24; ++slot) {
        // The fine voxel's path: octants 5, then 5 & (x 0, y 0, z 1) = 1, then (1, 1, 0) = 6.
        const float expected = slot == 5        ? 1
                               : slot == 8 + 1  ? 2
                               : slot == 16 + 6 ? 8 * scale
                               : slot >= 8      ? 2 * scale
                                                : 0;
        EXPECT_FLOAT_EQ(made.slots()[slot], expected) << slot;
    }
    EXPECT_EQ(made.colours()[16 + 6], glm::vec4(0.25f, 0.75f, 0, 1));
    EXPECT_EQ(made.colours()[16], glm::vec4(1, 0, 0, 1));
    made.set(TestTree(tree.lattice()).marched());
    EXPECT_TRUE(made.empty());
}

TEST(OctreeMarchTree, TakesFinestCellsWithoutNodesOfTheirOwn) {
    // A node with its own voxel and two finest cells, and another with a single finest cell.
    std::vector<NodeBlock> nodes(4), families(2);
    nodes[0].slots[5].children = families[0].slots[5].children = 1;
    nodes[1].slots[2] = {2, 1};
    nodes[2].slots[0].voxel = 2;
    nodes[2].slots[6].voxel = 3;
    nodes[1].slots[7].children = 3;
    nodes[3].slots[7].voxel = 4;
    families[1].slots[2] = {NodeSlot::familyFlag | NodeSlot::ownVoxelFlag | 0b0100'0001, 1};
    families[1].slots[7] = {NodeSlot::familyFlag | 0b1000'0000, 4};
    const std::array<float, 4> extinctions{1, 2, 4, 8};
    const std::array<glm::vec3, 4> colours{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1)};
    const Lattice lattice{glm::dvec3(0), 8, 3};
    OctreeMarchTree fromNodes, fromFamilies;
    fromNodes.set({lattice, nodes, extinctions, colours});
    fromFamilies.set({lattice, families, extinctions, colours});
    EXPECT_TRUE(std::ranges::equal(fromFamilies.slots(), fromNodes.slots()));
    EXPECT_TRUE(std::ranges::equal(fromFamilies.colours(), fromNodes.colours()));
    EXPECT_EQ(fromFamilies.minimum(), fromNodes.minimum());
    EXPECT_EQ(fromFamilies.maximum(), fromNodes.maximum());
}

TEST(OctreeMarchTree, RefusesWhatIsNoTree) {
    OctreeMarchTree made;
    const auto refused = [&](const MarchedTree& tree) { EXPECT_THROW(made.set(tree), std::invalid_argument); };
    const std::array<float, 1> one{1}, negative{-1}, nan{std::nanf("")}, endless{INFINITY};
    const std::array<glm::vec3, 2> colours{};
    std::vector<NodeBlock> voxel(1), outside(1), circle(2), deep(6), family(4);
    voxel[0].slots[3].voxel = 1;
    outside[0].slots[0].children = 1;
    circle[0].slots[1].children = 1;
    circle[1].slots[7].children = 1;
    for (std::uint32_t i = 0; i < 5; ++i) deep[i].slots[0].children = i + 1;
    for (std::uint32_t i = 0; i < 3; ++i) family[i].slots[0].children = i + 1;
    family[3].slots[0] = {NodeSlot::familyFlag | 1, 1};  // below the finest level
    const Lattice lattice{glm::dvec3(0), 16, 4};
    refused({lattice, family, one, {}});
    refused({lattice, voxel, {}, {}});
    refused({lattice, voxel, negative, {}});
    refused({lattice, voxel, nan, {}});
    refused({lattice, voxel, endless, {}});
    refused({lattice, voxel, one, colours});
    refused({lattice, outside, one, {}});
    refused({lattice, circle, one, {}});
    refused({lattice, deep, one, {}});
    refused({{glm::dvec3(0), 16, 13}, voxel, one, {}});
    refused({{glm::dvec3(0), 16, 0}, voxel, one, {}});
    made.set({lattice, voxel, one, {}});
    EXPECT_FALSE(made.empty());
}

}  // namespace
}  // namespace dustbench::octree
