#include "methods/shared/octree/octree_march_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "methods/shared/octree/octree_march_test_tree.h"

namespace dustbench::octree {
namespace {

TEST(OctreeMarchTree, SumsFromTheRootDownAndBoundsTheVoxels) {
    TestTree tree({glm::dvec3(0), 16, 4});
    tree.add({{1, 0, 1}, 1, 2, {1, 0, 0}});
    tree.add({{5, 1, 6}, 3, 6, {0, 1, 0}});
    OctreeMarchTree made;
    made.set(tree.marched(true));
    EXPECT_EQ(made.least(), glm::ivec3(8, 0, 8));
    EXPECT_EQ(made.most(), glm::ivec3(16, 8, 16));
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

TEST(OctreeMarchTree, RefusesWhatIsNoTree) {
    OctreeMarchTree made;
    const auto refused = [&](const MarchedTree& tree) { EXPECT_THROW(made.set(tree), std::invalid_argument); };
    const std::array<float, 1> one{1}, negative{-1}, nan{std::nanf("")}, endless{INFINITY};
    const std::array<glm::vec3, 2> colours{};
    std::vector<NodeBlock> voxel(1), outside(1), circle(2), deep(6);
    voxel[0].slots[3].voxel = 1;
    outside[0].slots[0].children = 1;
    circle[0].slots[1].children = 1;
    circle[1].slots[7].children = 1;
    for (std::uint32_t i = 0; i < 5; ++i) deep[i].slots[0].children = i + 1;
    const Lattice lattice{glm::dvec3(0), 16, 4};
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
