#include "methods/kit/octree/octree_dust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/contract/volume.h"
#include "methods/kit/octree/map_builder_test_tree.h"
#include "methods/kit/octree/particle_cells.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::octree {
namespace {

/// A trail behind a vehicle at the world's origin.
class Moment : public TestMoment {
 public:
    explicit Moment(std::size_t count) : TestMoment(count, 160, 120, {0, 6, 24}, {-6, -5, -24}) {
        std::mt19937 random(4);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const float life = uniform(random);
            dust.serial[i] = i;
            dust.x[i] = -12 * life;
            dust.y[i] = 0.5f + 2 * uniform(random);
            dust.z[i] = 3 * uniform(random) - 1.5f;
            dust.radius[i] = 0.3f + life;
            dust.opacity[i] = 0.05f + 0.1f * uniform(random);
            dust.lifetime[i] = 4;
            dust.age[i] = 4 * life;
        }
        dust.colourOfAll = {0.6f, 0.5f, 0.4f};
    }
};

OctreeDust make(const DustSettings& settings) {
    return {settings, [](MemoryLedger&) { return std::make_unique<MapBuilder>(); }};
}

DustSettings settingsOf(Render render, OpacityPolicy policy = OpacityPolicy::accumulate) {
    DustSettings settings;
    settings.tree.policy = policy;
    settings.render = render;
    return settings;
}

/// Optical depth summed over the picture.
double depthOf(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum -= std::log1p(-static_cast<double>(pixel.a));
    return sum;
}

TEST(OctreeDust, ShowsTheSameMassHoweverItIsDrawn) {
    Moment moment(800);
    std::map<Render, double> depths;
    for (const Render render : {Render::billboards, Render::cubes, Render::raycast}) {
        OctreeDust method = make(settingsOf(render));
        method.prepare(moment.scene, {}, Moment::device());
        method.update(moment.frame());
        depths[render] = depthOf(moment.draw(method));
    }
    ASSERT_GT(depths[Render::raycast], 100);
    EXPECT_NEAR(depths[Render::billboards] / depths[Render::raycast], 1, 0.03);
    // Flat faces count an oblique crossing like a straight one: too much where rays cut off corners.
    EXPECT_NEAR(depths[Render::cubes] / depths[Render::raycast], 1, 0.45);
}

FactValue factOf(const OctreeDust& method, const Moment& moment, const char* name, FactOver over) {
    MethodInfo info;
    declareDust(info);
    Facts facts(info.facts, over);
    method.report(moment.frame(), facts);
    return facts.value(name).value();
}

TEST(OctreeDust, KeepsAllMassWhereItAccumulatesAndSaysWhatElseItDrops) {
    Moment moment(3000);
    std::map<OpacityPolicy, double> kept;
    for (const OpacityPolicy policy : {OpacityPolicy::accumulate, OpacityPolicy::max, OpacityPolicy::youngest}) {
        OctreeDust method = make(settingsOf(Render::raycast, policy));
        method.prepare(moment.scene, {}, Moment::device());
        method.update(moment.frame());
        kept[policy] = std::get<double>(factOf(method, moment, "mass_kept", FactOver::lastFrame));
    }
    EXPECT_NEAR(kept[OpacityPolicy::accumulate], 1, 1e-6);
    EXPECT_LT(kept[OpacityPolicy::max], 0.9);
    EXPECT_LT(kept[OpacityPolicy::youngest], kept[OpacityPolicy::accumulate]);
    EXPECT_GT(kept[OpacityPolicy::youngest], 0.01);
}

TEST(OctreeDust, HoldsATrailThatIsLongerThanHalfItsWorld) {
    Moment moment(1000);
    for (float& x : moment.dust.x) x *= 8;  // 96 m, in a world of 128 m
    OctreeDust method = make(settingsOf(Render::raycast));
    const auto clipped = [&] {
        return std::get<std::int64_t>(factOf(method, moment, "clipped", FactOver::maximumOfFrames));
    };
    method.prepare(moment.scene, {}, Moment::device());
    method.update(moment.frame());
    EXPECT_EQ(clipped(), 0);
    EXPECT_NEAR(std::get<double>(factOf(method, moment, "mass_kept", FactOver::lastFrame)), 1, 1e-6);
    // A single distant particle is dropped and counted, and does not affect the others.
    moment.dust.x[7] = -1e7f;
    method.update(moment.frame());
    EXPECT_GE(clipped(), 1);
    EXPECT_LT(clipped(), 300);
}

/// Position, edge and mass of every voxel that is drawn.
std::set<std::tuple<float, float, float, float, float>> voxelsOf(const OctreeDust& method) {
    const VoxelCloud& cloud = method.shown();
    std::set<std::tuple<float, float, float, float, float>> voxels;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        voxels.emplace(cloud.x[i], cloud.y[i], cloud.z[i], cloud.edge[i], cloud.mass[i]);
    return voxels;
}

/// The remaining part of a trail of this length, at this depth.
struct Held {
    std::int64_t clipped;
    double lost, edge;
};
Held heldOf(float metres, int depth) {
    Moment moment(1000);
    for (float& x : moment.dust.x) x *= metres / 12;
    DustSettings settings = settingsOf(Render::raycast);
    settings.tree.depth = depth;
    OctreeDust method = make(settings);
    method.prepare(moment.scene, {}, Moment::device());
    method.update(moment.frame());
    (void)moment.draw(method);
    return {std::get<std::int64_t>(factOf(method, moment, "clipped", FactOver::maximumOfFrames)),
            std::get<double>(factOf(method, moment, "mass_lost", FactOver::lastFrame)),
            std::get<double>(factOf(method, moment, "world_edge_max", FactOver::maximumOfFrames))};
}

TEST(OctreeDust, DoublesItsWorldUntilItHoldsTheTrail) {
    for (const auto& [metres, edge] : std::map<float, double>{{50, 128}, {100, 128}, {200, 256}, {800, 1024}}) {
        const Held held = heldOf(metres, 8);
        EXPECT_EQ(held.clipped, 0) << metres;
        EXPECT_LT(held.lost, 1e-6) << metres;
        EXPECT_EQ(held.edge, edge) << metres;
    }
}

TEST(OctreeDust, KeepsTheVoxelsSizesAndPlacesWhileItsWorldGrows) {
    for (const OpacityPolicy policy : {OpacityPolicy::accumulate, OpacityPolicy::youngest}) {
        std::vector<std::set<std::tuple<float, float, float, float, float>>> voxels;
        for (const int doublings : {0, 1, 2}) {  // the trail needs one
            Moment moment(1500);
            for (float& x : moment.dust.x) x *= 200.0f / 12;
            DustSettings settings = settingsOf(Render::billboards, policy);
            settings.tree.depth += doublings;
            settings.worldEdgeMetres *= 1 << doublings;
            OctreeDust method = make(settings);
            method.prepare(moment.scene, {}, Moment::device());
            method.update(moment.frame());
            voxels.push_back(voxelsOf(method));
        }
        EXPECT_GT(voxels[0].size(), 100u);
        EXPECT_EQ(voxels[0], voxels[1]);
        EXPECT_EQ(voxels[0], voxels[2]);
    }
}

TEST(OctreeDust, SaysWhatItLosesWhereItsWorldCannotGrow) {
    MethodInfo info;
    declareDust(info);
    const auto valid = [&](const char* name, double value) {
        return std::ranges::find(info.facts, name, &FactInfo::name)->valid.contains(value);
    };
    const Held held = heldOf(200, maximumDepth);
    EXPECT_EQ(held.edge, 128);
    EXPECT_GT(held.clipped, 100);
    EXPECT_GT(held.lost, 0.1);
    EXPECT_FALSE(valid("clipped", static_cast<double>(held.clipped)));
    EXPECT_FALSE(valid("mass_lost", held.lost));
    EXPECT_TRUE(valid("clipped", 0));
    EXPECT_TRUE(valid("mass_lost", 1e-6));
    EXPECT_TRUE(valid("mass_kept", 0.2));  // by the policies max and youngest
    EXPECT_EQ(heldOf(200, maximumDepth - 1).clipped, 0);
}

TEST(OctreeDust, ShowsTheSameVoxelsInALargerWorldOfTheSameFinestEdge) {
    for (const OpacityPolicy policy : {OpacityPolicy::accumulate, OpacityPolicy::max})
        for (const int levels : {1, 4, 8}) {
            std::vector<std::set<std::tuple<float, float, float, float, float>>> voxels;
            for (const int doublings : {0, 1, 3}) {
                Moment moment(1500);
                DustSettings settings = settingsOf(Render::billboards, policy);
                settings.tree.levels = levels;
                settings.tree.depth += doublings;
                settings.worldEdgeMetres *= 1 << doublings;
                OctreeDust method = make(settings);
                method.prepare(moment.scene, {}, Moment::device());
                method.update(moment.frame());
                voxels.push_back(voxelsOf(method));
            }
            EXPECT_GT(voxels[0].size(), 1u);
            EXPECT_EQ(voxels[0], voxels[1]) << levels;
            EXPECT_EQ(voxels[0], voxels[2]) << levels;
        }
}

TEST(OctreeDust, HandsOverItsVoxelsWithTheirMass) {
    class Collector final : public VolumeVisitor {
     public:
        void puffs(const Puffs&) override { ADD_FAILURE() << "puffs"; }
        void grid(const GridVolume&) override { ADD_FAILURE() << "grid"; }
        void octree(const OctreeVolume& volume) override {
            std::set<std::tuple<int, unsigned, unsigned, unsigned>> cells;
            for (const OctreeVoxel& voxel : volume.voxels) {
                const double edge = volume.edgeMetres / static_cast<double>(1u << voxel.level);
                mass += static_cast<double>(voxel.extinctionPerMetre) * edge * edge * edge;
                EXPECT_TRUE(cells.emplace(voxel.level, voxel.x, voxel.y, voxel.z).second);
                EXPECT_LT(std::max({voxel.x, voxel.y, voxel.z}), 1u << voxel.level);
            }
            count = volume.voxels.size();
        }
        double mass = 0;
        std::size_t count = 0;
    } collector;
    Moment moment(2000);
    OctreeDust method = make(settingsOf(Render::billboards));
    method.prepare(moment.scene, {}, Moment::device());
    method.update(moment.frame());
    method.volume(moment.frame(), collector);
    double mass = 0;
    const VoxelRule rule(moment.dust, OpacityPolicy::accumulate);
    for (std::uint32_t i = 0; i < moment.dust.size(); ++i) mass += rule.massSquareMetres(i);
    EXPECT_NEAR(collector.mass, mass, 1e-5 * mass);
    EXPECT_EQ(static_cast<std::int64_t>(collector.count), method.primitives());
}

TEST(OctreeDust, GivesAVoxelAnOpacityByAgeAloneWhateverItsSize) {
    class Collector final : public VolumeVisitor {
     public:
        void puffs(const Puffs&) override { ADD_FAILURE() << "puffs"; }
        void grid(const GridVolume&) override { ADD_FAILURE() << "grid"; }
        void octree(const OctreeVolume& volume) override {
            for (const OctreeVoxel& voxel : volume.voxels) {
                const double edge = volume.edgeMetres / static_cast<double>(1u << voxel.level);
                const double alpha = -std::expm1(-static_cast<double>(voxel.extinctionPerMetre) * edge);
                EXPECT_NEAR(alpha, 0.6 * (1 - static_cast<double>(voxel.ageSeconds) / 4), 1e-5);
                levels.insert(voxel.level);
            }
        }
        std::set<int> levels;
    };
    Moment moment(1000);
    for (const OpacityPolicy policy : {OpacityPolicy::max, OpacityPolicy::youngest}) {
        DustSettings settings = settingsOf(Render::circles, policy);
        settings.opacity = draw::OpacityFrom::age;
        settings.youngOpacity = 0.6;
        OctreeDust method = make(settings);
        method.prepare(moment.scene, {}, Moment::device());
        method.update(moment.frame());
        Collector collector;
        method.volume(moment.frame(), collector);
        EXPECT_EQ(collector.levels.size(), 4u);
    }
}

TEST(VoxelOpacity, LeavesParticlesInTheirVoxels) {
    Moment moment(1000);
    MemoryLedger ledger;
    VoxelOpacity byAge(ledger, 0.5);
    for (const LevelRule rule : {LevelRule::age, LevelRule::radius}) {
        OctreeSettings settings;
        settings.levelRule = rule;
        const Lattice lattice;
        const Puffs dust = moment.dust, shown = byAge.of(dust, lattice, settings);
        const ParticlePlace before(dust, lattice, settings), after(shown, lattice, settings);
        std::set<int> levels;
        for (std::size_t i = 0; i < dust.size(); ++i) {
            ASSERT_EQ(after.level(i), before.level(i));
            levels.insert(after.level(i));
        }
        EXPECT_GE(levels.size(), 2u);
    }
}

TEST(OctreeDust, DrawsAVoxelAsAPlainCircleOfItsOpacity) {
    Moment moment(1);
    moment.dust.x[0] = moment.dust.z[0] = 0;
    moment.dust.y[0] = 1;
    moment.dust.age[0] = 1;
    moment.dust.radius[0] = 77;  // without effect
    moment.dust.opacity[0] = 0.01f;
    DustSettings settings = settingsOf(Render::circles);
    settings.opacity = draw::OpacityFrom::age;
    settings.tree.depth = 5;
    settings.tree.levels = 1;  // a voxel of 4 m, centred at 2 m
    OctreeDust method = make(settings);
    method.prepare(moment.scene, {}, Moment::device());
    method.update(moment.frame());
    const pictures::Image image = moment.draw(method);
    const glm::dvec3 centre = glm::dvec3(2) - moment.view.camera.eye;
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 ray = moment.view.rayDirection(x + 0.5, y + 0.5);
            const double cosine = glm::dot(ray, glm::normalize(centre));
            const double offset = glm::length(centre) * std::sqrt(1 - cosine * cosine) / cosine;
            const double u = std::min(offset / (2 * std::numbers::sqrt3), 1.0);  // half the cube's diagonal
            ASSERT_NEAR(image.at(x, y).a, 0.375 * (1 - 3 * u * u + 2 * u * u * u), 1e-4) << x << ',' << y;
            largest = std::max(largest, static_cast<double>(image.at(x, y).a));
        }
    EXPECT_NEAR(largest, 0.375, 1e-3);
}

TEST(OctreeDust, DrawsTheSameAgainInEveryWay) {
    Moment moment(500);
    for (const Render render : {Render::billboards, Render::circles, Render::cubes, Render::raycast})
        for (const bool fades : {false, true}) {
            DustSettings settings = settingsOf(render, OpacityPolicy::max);
            settings.crossFade = fades;
            OctreeDust method = make(settings);
            method.prepare(moment.scene, {}, Moment::device());
            for (int frame = 0; frame < 3; ++frame) {
                for (float& x : moment.dust.x) x += 0.1f;
                method.update(moment.frame());
            }
            const pictures::Image first = moment.draw(method);
            EXPECT_EQ(moment.draw(method).pixels, first.pixels);
            EXPECT_GT(depthOf(first), 10);
        }
}

TEST(OctreeSettings, RefusesMoreLevelsThanThereAre) {
    MethodInfo info;
    declareDust(info);
    ParameterValues values(info.parameters);
    values.set("depth", "5");
    values.set("levels", "6");
    EXPECT_THROW((void)dustSettings(values), InputError);
    values.set("levels", "5");
    EXPECT_EQ(dustSettings(values).tree.levels, 5);
}

TEST(OctreeDust, HasAPresetOfThePaper) {
    MethodInfo info;
    declareDust(info);
    declareLayout(info, "how");
    ParameterValues values(info.parameters);
    EXPECT_EQ(values.choice("layout"), "faithful");
    EXPECT_EQ(dustSettings(values).opacity, draw::OpacityFrom::dust);
    values.set("mode", "paper");
    EXPECT_EQ(values.choice("layout"), "paper");
    const DustSettings settings = dustSettings(values);
    EXPECT_EQ(settings.opacity, draw::OpacityFrom::age);
    EXPECT_EQ(settings.render, Render::circles);
    EXPECT_EQ(settings.sort, draw::SortKind::quicksort);
}

}  // namespace
}  // namespace dustbench::octree
