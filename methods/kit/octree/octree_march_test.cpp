#include "methods/kit/octree/octree_march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/octree/octree_march_test_tree.h"

namespace dustbench::octree {
namespace {

class Canvas : public draw::TestCanvas {
 public:
    Canvas() : TestCanvas(96, 72, {0, 0, 0}, {0, 0, -1}) {}

    pictures::Image draw(OctreeMarch& march) {
        return picture([&](const gpu::Layer& layer) { march.draw(view, colourOfAll, layer); });
    }

    /// The ray of a pixel: its direction in double precision, and the distance from the eye at which it ends.
    struct Ray {
        glm::dvec3 direction;
        double end;
    };
    [[nodiscard]] Ray ray(int x, int y) const {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(view.rayDirection(x + 0.5, y + 0.5)));
        const glm::dvec3 forward = glm::normalize(view.camera.target - view.camera.eye);
        return {direction, wallAt(x) / glm::dot(direction, forward)};
    }

    glm::vec3 colourOfAll{0.5f, 0.25f, 0.125f};
};

struct Segment {
    double enter, leave;
};

Segment crossing(const Lattice& lattice, const TestVoxel& voxel, const glm::dvec3& eye, const Canvas::Ray& ray) {
    const double edge = lattice.cellEdgeMetres(voxel.level);
    Segment segment{0, ray.end};
    for (int axis = 0; axis < 3; ++axis) {
        const double minimum = lattice.origin[axis] + edge * voxel.cell[axis] - eye[axis], maximum = minimum + edge;
        if (ray.direction[axis] == 0) {
            if (minimum > 0 || maximum <= 0) return {0, 0};
            continue;
        }
        const double a = minimum / ray.direction[axis], b = maximum / ray.direction[axis];
        segment.enter = std::max(segment.enter, std::min(a, b));
        segment.leave = std::min(segment.leave, std::max(a, b));
    }
    return segment.enter < segment.leave ? segment : Segment{0, 0};
}

/// Sums over all voxels, including overlapping ones: Σ extinction × length of the ray within it.
double opticalDepth(const TestTree& tree, const glm::dvec3& eye, const Canvas::Ray& ray) {
    double depth = 0;
    for (const TestVoxel& voxel : tree.voxels()) {
        const auto [enter, leave] = crossing(tree.lattice(), voxel, eye, ray);
        depth += static_cast<double>(voxel.extinctionPerMetre) * (leave - enter);
    }
    return depth;
}

/// ∫ T·Σ σᵢcᵢ dt between consecutive points where the ray enters or leaves a voxel.
glm::dvec4 colourAlong(const TestTree& tree, const glm::dvec3& eye, const Canvas::Ray& ray) {
    std::vector<std::pair<Segment, const TestVoxel*>> crossings;
    std::vector<double> places;
    for (const TestVoxel& voxel : tree.voxels()) {
        const Segment segment = crossing(tree.lattice(), voxel, eye, ray);
        if (segment.leave <= segment.enter) continue;
        crossings.emplace_back(segment, &voxel);
        places.insert(places.end(), {segment.enter, segment.leave});
    }
    std::ranges::sort(places);
    glm::dvec4 sum(0);
    double transmittance = 1;
    for (std::size_t i = 1; i < places.size(); ++i) {
        const double middle = (places[i - 1] + places[i]) / 2;
        double extinction = 0;
        glm::dvec3 weighted(0);
        for (const auto& [segment, voxel] : crossings) {
            if (middle < segment.enter || middle > segment.leave) continue;
            extinction += static_cast<double>(voxel->extinctionPerMetre);
            weighted += static_cast<double>(voxel->extinctionPerMetre) * glm::dvec3(voxel->colour);
        }
        if (extinction <= 0) continue;
        const double share = -std::expm1(-extinction * (places[i] - places[i - 1]));
        sum += transmittance * share * glm::dvec4(weighted / extinction, 1);
        transmittance *= 1 - share;
    }
    return sum;
}

constexpr double bound = 1.2e-4;  ///< 2^-14 for rays that end early, and float rounding

/// Compares every `step`-th pixel with the sums in double precision. Returns the mean alpha.
double expectSums(const Canvas& canvas, const TestTree& tree, const pictures::Image& image, bool coloured,
                  int step = 1) {
    double total = 0;
    int count = 0;
    for (int y = 0; y < image.height; y += step)
        for (int x = y / step % 2; x < image.width; x += step) {
            const Canvas::Ray ray = canvas.ray(x, y);
            const double alpha = -std::expm1(-opticalDepth(tree, canvas.view.camera.eye, ray));
            glm::dvec4 expected(alpha * glm::dvec3(canvas.colourOfAll), alpha);
            if (coloured) expected = colourAlong(tree, canvas.view.camera.eye, ray);
            for (int i = 0; i < 4; ++i)
                if (!(std::abs(static_cast<double>(image.at(x, y)[i]) - expected[i]) < bound)) {
                    ADD_FAILURE() << x << ',' << y << " channel " << i << ": " << image.at(x, y)[i] << " instead of "
                                  << expected[i];
                    return 0;
                }
            total += expected.a;
            ++count;
        }
    return total / count;
}

glm::dvec3 somewhere(std::mt19937& random, double spread) {
    std::uniform_real_distribution<double> wide(-spread, spread);
    const double x = wide(random), y = wide(random), z = wide(random);
    return {x, y, z};
}

/// Clustered voxels of all levels, so that coarse ones overlap fine ones.
TestTree randomTree(const Lattice& lattice, std::mt19937& random, int count) {
    TestTree tree(lattice);
    std::uniform_real_distribution<double> share(0, 1);
    std::uniform_int_distribution<int> levels(1, lattice.depth);
    glm::dvec3 cluster(0.5);
    for (int i = 0; i < count; ++i) {
        if (i % 8 == 0) cluster = 0.5 + somewhere(random, 0.4);
        const int level = levels(random);
        const double edge = 1.0 / lattice.cellsPerEdge(level);
        const glm::dvec3 place = glm::clamp(cluster + somewhere(random, 2 * edge), 0.0, 0.999999);
        const double opticalDepth = 1.5 * share(random) * share(random);
        const auto extinction = static_cast<float>(opticalDepth / lattice.cellEdgeMetres(level));
        const glm::vec3 colour(glm::vec3(0.5) + 0.5f * glm::vec3(somewhere(random, 1)));
        tree.add({glm::uvec3(place / edge), level, extinction, colour});
    }
    return tree;
}

TEST(OctreeMarch, SumsUpExtinctionTimesLengthOverAllVoxels) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    std::mt19937 random(3);
    double total = 0;
    for (int round = 0; round < 24; ++round) {
        const int depth = 4 + round % 9;
        const Lattice lattice{somewhere(random, 300), round % 2 ? 128.0 : 7.3, depth};
        const TestTree tree = randomTree(lattice, random, 10 + 10 * round);
        const glm::dvec3 middle = lattice.origin + lattice.edgeMetres / 2;
        // From outside towards the centre, and from inside in any direction; every third round with a wall.
        const glm::dvec3 eye = middle + somewhere(random, (round % 4 < 2 ? 1.2 : 0.4) * lattice.edgeMetres);
        canvas.lookFrom(eye, round % 4 < 2 ? middle - eye : somewhere(random, 1));
        canvas.setWall(round % 3 == 2 ? std::optional(0.4 * lattice.edgeMetres) : std::nullopt, 48);
        for (const bool coloured : {false, true}) {
            march.upload(tree.marched(coloured));
            total += expectSums(canvas, tree, canvas.draw(march), coloured, coloured ? 5 : 2);
        }
        if (HasFailure()) FAIL() << "round " << round;
    }
    EXPECT_GT(total / 48, 0.05);
}

TEST(OctreeMarch, EqualsTheSumsForADenseBlockOfFineCells) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    std::mt19937 random(5);
    std::uniform_real_distribution<float> extinction(0, 0.4f);
    TestTree tree({glm::dvec3(-8), 16, 4});
    for (std::uint32_t cell = 0; cell < 4096; ++cell)
        tree.add({{cell >> 8, cell >> 4 & 15u, cell & 15u}, 4, extinction(random)});
    march.upload(tree.marched());
    canvas.lookFrom({9, 13, 17}, {-10, -13, -16});
    EXPECT_GT(expectSums(canvas, tree, canvas.draw(march), false, 3), 0.3);
    canvas.lookFrom({0.5, 0.25, 0.75}, {1, 0.3, 0.2});
    EXPECT_GT(expectSums(canvas, tree, canvas.draw(march), false, 3), 0.3);
}

TEST(OctreeMarch, FollowsRaysAlongTheAxesAndTheBordersOfCells) {
    Canvas canvas;
    // An odd number of pixels: the middle ray is the camera's axis, with two components of exactly 0.
    canvas.view.width = 95;
    canvas.view.height = 71;
    OctreeMarch march(Canvas::device());
    TestTree tree({glm::dvec3(-8), 16, 4});
    for (std::uint32_t i = 0; i < 16; ++i) tree.add({{i, 15 - i, 8}, 4, 0.25f});
    for (std::uint32_t i = 0; i < 8; ++i) tree.add({{i, 4, 4}, 3, 0.125f});
    for (std::uint32_t i = 0; i < 4; ++i) tree.add({{2, i, 2}, 2, 0.0625f});
    march.upload(tree.marched());
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0})
            for (const double aside : {0.5, 0.0}) {  // through the middle of cells, and between four of them
                glm::dvec3 along(0), eye(aside);
                along[axis] = sign;
                eye[axis] = -12 * sign;
                canvas.lookFrom(eye, along);
                const pictures::Image image = canvas.draw(march);
                for (const glm::vec4& pixel : image.pixels) ASSERT_TRUE(pixel.a >= 0 && pixel.a <= 1);
                if (aside > 0) {
                    const Canvas::Ray middle{along, std::numeric_limits<double>::infinity()};
                    EXPECT_NEAR(image.at(47, 35).a, -std::expm1(-opticalDepth(tree, eye, middle)), bound);
                }
            }
}

TEST(OctreeMarch, FromWithinAVoxelSeesTheRestOfIt) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    TestTree tree({glm::dvec3(-64), 128, 8});
    tree.add({{8, 8, 8}, 4, 0.2f});                 // [0, 8)³
    tree.add({{128 + 8, 128 + 8, 128 + 8}, 8, 2});  // within it
    march.upload(tree.marched());
    for (const glm::dvec3& eye : {glm::dvec3(4, 4, 4), glm::dvec3(0.01, 7.99, 4), glm::dvec3(0, 0, 0),
                                  glm::dvec3(4.25, 4.25, 4.25), glm::dvec3(8, 8, 8), glm::dvec3(-0.05, 4, 4)})
        for (const glm::dvec3& along : {glm::dvec3(1, 0.2, 0.1), glm::dvec3(-0.3, -1, 0.2), glm::dvec3(0.1, 0.2, -1)}) {
            canvas.lookFrom(eye, along);
            expectSums(canvas, tree, canvas.draw(march), false);
        }
    canvas.lookFrom({4, 4, 4}, {1, 0.2, 0.1});
    EXPECT_GT(expectSums(canvas, tree, canvas.draw(march), false), 0.5);
}

TEST(OctreeMarch, EndsAtTheScene) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    TestTree tree({glm::dvec3(-64), 128, 8});
    tree.add({{8, 8, 6}, 4, 0.1f});  // z from −16 to −8
    march.upload(tree.marched());
    canvas.lookFrom({4, 4, 2}, {0, 0, -1});
    for (const double wall : {9.9, 10.0, 12.0, 17.9, 30.0}) {
        canvas.setWall(wall, 48);
        const pictures::Image image = canvas.draw(march);
        expectSums(canvas, tree, image, false);
        EXPECT_NEAR(image.at(50, 36).a, -std::expm1(-0.1 * std::clamp(wall - 10, 0.0, 8.0)), 1e-3) << wall;
    }
}

TEST(OctreeMarch, ReachesTheFinestOfTwelveLevelsFarFromTheWorldsOrigin) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    const Lattice lattice{{100'000, 0, -50'000}, 128, 12};
    for (const glm::uvec3& cell : {glm::uvec3(0), glm::uvec3(4095), glm::uvec3(2047, 2048, 1234)}) {
        TestTree tree(lattice);
        tree.add({cell, 12, 30});
        march.upload(tree.marched());
        const glm::dvec3 centre = lattice.origin + (glm::dvec3(cell) + 0.5) * lattice.cellEdgeMetres(12);
        canvas.view.camera.nearMetres = 0.01;
        canvas.lookFrom(centre + glm::dvec3(0.06, 0.03, 0.05), glm::dvec3(-0.06, -0.03, -0.05));
        int filled = 0;
        const pictures::Image image = canvas.draw(march);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                // The world's position limits precision: float cell coordinates leave errors of about 1e-4 of an edge.
                const Canvas::Ray ray = canvas.ray(x, y);
                const double alpha = -std::expm1(-opticalDepth(tree, canvas.view.camera.eye, ray));
                ASSERT_NEAR(image.at(x, y).a, alpha, 2e-3) << x << ',' << y;
                filled += alpha > 0.1;
            }
        EXPECT_GT(filled, 500);
    }
}

TEST(OctreeMarch, IsTheSameWhereverTheBoxIsCutByThePicture) {
    // A box beyond the near plane is drawn by its faces, any other by the whole image.
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    std::mt19937 random(11);
    const TestTree tree = randomTree({glm::dvec3(-1), 2, 5}, random, 60);
    march.upload(tree.marched());
    for (const double distance : {1.02, 1.11, 1.3, 2.0, 6.0, 80.0})
        for (const glm::dvec3& along : {glm::dvec3(0, 0, -1), glm::dvec3(0.5, 0.4, -1), glm::dvec3(-1, 0, -0.4)}) {
            canvas.lookFrom({0.1, -0.2, distance}, along);
            expectSums(canvas, tree, canvas.draw(march), false);
        }
    canvas.lookFrom({0, 0, 5}, {0, 0, 1});
    for (const glm::vec4& pixel : canvas.draw(march).pixels) ASSERT_EQ(pixel, glm::vec4(0));
}

TEST(OctreeMarch, MixesColoursByExtinctionAndHidesWhatIsBehind) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    TestTree tree({glm::dvec3(-8), 16, 4});
    tree.add({{1, 1, 1}, 1, 0.3f, {1, 0, 0}});  // [0, 8)³
    tree.add({{2, 2, 2}, 2, 0.1f, {0, 1, 0}});  // [0, 4)³ within it
    tree.add({{8, 8, 0}, 4, 1.0f, {0, 0, 1}});  // far behind
    march.upload(tree.marched(true));
    canvas.lookFrom({0.5, 0.5, 11}, {0, 0, -1});
    const glm::vec4 pixel = canvas.draw(march).at(48, 36);
    const double red = 0.3 * 4, both = 0.4 * 4;
    EXPECT_NEAR(pixel.r, -std::expm1(-red) - 0.75 * std::exp(-red) * std::expm1(-both), 1e-3);
    EXPECT_NEAR(pixel.g, -0.25 * std::exp(-red) * std::expm1(-both), 1e-3);
    EXPECT_NEAR(pixel.b, -std::exp(-red - both) * std::expm1(-1.0), 1e-3);
    expectSums(canvas, tree, canvas.draw(march), true);
}

TEST(OctreeMarch, OfTreesThatComeAndGoDrawsTheLatestAndTheSameAgain) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    const Lattice lattice{glm::dvec3(-8), 16, 6};
    canvas.lookFrom({3, 4, 22}, {-3, -4, -22});
    std::mt19937 random(2);
    const TestTree none(lattice), large = randomTree(lattice, random, 3000), small = randomTree(lattice, random, 20);
    const pictures::Image nothing = canvas.draw(march);
    for (const glm::vec4& pixel : nothing.pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(march.gpuBytes(), 0u);
    std::size_t bytes = 0;
    for (const TestTree* tree : {&small, &large, &none, &small, &large})
        for (const bool coloured : {false, true}) {
            march.upload(tree->marched(coloured));
            const pictures::Image image = canvas.draw(march);
            EXPECT_EQ(canvas.draw(march).pixels, image.pixels);
            if (tree == &none)
                EXPECT_EQ(image.pixels, nothing.pixels);
            else
                EXPECT_GT(expectSums(canvas, *tree, image, coloured, 9), 0.01);
            EXPECT_GE(march.gpuBytes(), bytes);  // memory is kept
            bytes = coloured ? march.gpuBytes() : bytes;
        }
    EXPECT_GT(bytes, 0u);
    EXPECT_GT(march.cpuBytes(), 0u);
}

TEST(OctreeMarch, AfterARefusedTreeDrawsNothing) {
    Canvas canvas;
    OctreeMarch march(Canvas::device());
    canvas.lookFrom({0, 0, 20}, {0, 0, -1});
    TestTree tree({glm::dvec3(-8), 16, 4});
    tree.add({{3, 3, 3}, 2, 0.5f});
    tree.add({{1, 1, 1}, 2, std::nanf("")});
    march.upload(trailTree({glm::dvec3(-64), 128, 8}, 10).marched());
    EXPECT_THROW(march.upload(tree.marched()), std::invalid_argument);
    for (const glm::vec4& pixel : canvas.draw(march).pixels) ASSERT_EQ(pixel, glm::vec4(0));
}

}  // namespace
}  // namespace dustbench::octree
