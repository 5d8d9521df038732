// The GPU's octree against that of the CPU, with the simplest builder.
#include "methods/kit/octree/gpu/gpu_octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/gpu/faulty_driver.h"
#include "methods/kit/octree/gpu/gpu_octree_dust.h"
#include "methods/kit/octree/map_builder_test_tree.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::octree {
namespace {

enum class Cloud { trail, oneCell, cellBorders, outside, notFinite };
constexpr std::array clouds{Cloud::trail, Cloud::oneCell, Cloud::cellBorders, Cloud::outside, Cloud::notFinite};

struct CloudMoment : TestMoment {
    CloudMoment() : TestMoment(0, 160, 120, {0, 6, 24}, {-6, -5, -24}) { dust.colourOfAll = {0.6f, 0.5f, 0.4f}; }

    void fill(Cloud cloud, std::size_t count, std::mt19937& random) {
        std::uniform_real_distribution<float> unit(0, 1);
        dust.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            glm::vec3 p(-14 * unit(random), 0.3f + 3 * unit(random) * unit(random), 4 * unit(random) - 2);
            if (cloud == Cloud::oneCell && i % 64 != 5) p = {0.01f, 0.02f, 0.03f};
            if (cloud == Cloud::cellBorders) p = glm::round(8.0f * p) / 8.0f;
            if (cloud == Cloud::outside && random() % 8 == 0) p *= 1e9f;
            if (cloud == Cloud::notFinite && random() % 8 == 0) p.x = std::numeric_limits<float>::infinity();
            dust.x[i] = p.x, dust.y[i] = p.y, dust.z[i] = p.z;
            dust.lifetime[i] = 1 + 3 * unit(random);
            dust.age[i] = random() % 4 == 0 ? 0.25f : dust.lifetime[i] * unit(random);
            if (cloud == Cloud::oneCell) dust.age[i] = 0.01f * static_cast<float>(i % 3);
            dust.opacity[i] = random() % 4 == 0 ? 0.125f : 0.999f * unit(random);
            dust.radius[i] = 0.01f + 2 * unit(random);
            dust.serial[i] = i * 2654435761u % 4294967291u;  // in another order than in memory
        }
        if (!dust.uniformColour) dust.keepOneColour(false);
    }
};

OctreeDust onCpu(const DustSettings& settings) {
    return {settings, [](MemoryLedger&) { return std::make_unique<MapBuilder>(); }};
}

std::int64_t clippedOf(const OctreeDust& method, const CloudMoment& moment) {
    MethodInfo info;
    declareDust(info);
    Facts facts(info.facts, FactOver::maximumOfFrames);
    method.report(moment.frame(), facts);
    return std::get<std::int64_t>(facts.value("clipped").value());
}

/// Cells, levels, order and representing particles exactly; masses within rounding.
void expectEqual(const GpuOctree& gpu, const OctreeDust& cpu, const CloudMoment& moment) {
    const GpuOctreeNumbers numbers = gpu.readNumbers();
    const VoxelCloud& expected = cpu.shown();
    ASSERT_EQ(numbers.lattice, expected.lattice);
    ASSERT_EQ(numbers.particles, moment.dust.size());
    ASSERT_EQ(numbers.clipped, clippedOf(cpu, moment));
    const std::vector<GpuVoxel> voxels = gpu.readVoxels();
    ASSERT_EQ(voxels.size(), expected.size());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        ASSERT_EQ(voxels[i].place, expected.place[i]) << i;
        ASSERT_EQ(voxels[i].particle, cpu.tree().voxels()[i].index()) << i;
        ASSERT_FLOAT_EQ(voxels[i].massSquareMetres, expected.mass[i]) << i;
    }
}

/// Both methods, reused: nothing of a cloud before may remain.
struct Pair {
    void compare(const CloudMoment& moment, const DustSettings& settings) {
        OctreeDust cpu = onCpu(settings);
        cpu.prepare(moment.scene, {}, TestMoment::device());
        cpu.update(moment.frame());
        const StageClock untimed;
        gpu.build(upload.upload(moment.dust), settings, moment.state.vehicle.position, true, untimed);
        expectEqual(gpu, cpu, moment);
    }

    GpuOctree gpu{TestMoment::device()};
    PuffUpload upload{TestMoment::device()};
};

std::string described(const DustSettings& settings, Cloud cloud, std::size_t count) {
    return "depth " + std::to_string(settings.tree.depth) + ", levels " + std::to_string(settings.tree.levels) +
           ", policy " + std::to_string(static_cast<int>(settings.tree.policy)) + ", rule " +
           std::to_string(static_cast<int>(settings.tree.levelRule)) + ", cloud " +
           std::to_string(static_cast<int>(cloud)) + ", particles " + std::to_string(count);
}

/// Every depth and policy, with the rules and numbers of levels in turn; up to depth 10 keys have one word.
TEST(GpuOctree, HasTheVoxelsOfTheCpu) {
    Pair pair;
    CloudMoment moment;
    std::mt19937 random(56);
    int set = 0;
    for (int depth = 1; depth <= maximumDepth; ++depth)
        for (const OpacityPolicy policy : {OpacityPolicy::max, OpacityPolicy::youngest, OpacityPolicy::accumulate})
            for (const std::size_t count : {static_cast<std::size_t>(depth % 3), std::size_t{1000}}) {
                DustSettings settings;
                settings.tree = {depth, 1 + set % depth, policy, set % 4 < 2 ? LevelRule::age : LevelRule::radius};
                settings.worldEdgeMetres = set % 3 == 0 ? 16.0 : 128.0;
                settings.worldGrows = set % 5 != 0;
                const Cloud cloud = clouds[static_cast<std::size_t>(set++) % clouds.size()];
                SCOPED_TRACE(described(settings, cloud, count));
                moment.fill(cloud, count, random);
                ASSERT_NO_FATAL_FAILURE(pair.compare(moment, settings));
            }
}

/// 50,000 particles, also of one cell: longer runs than a work group, and than a block of 4096.
TEST(GpuOctree, HasTheVoxelsOfTheCpuForManyParticles) {
    Pair pair;
    CloudMoment moment;
    std::mt19937 random(57);
    for (const Cloud cloud : clouds)
        for (const OpacityPolicy policy : {OpacityPolicy::max, OpacityPolicy::accumulate}) {
            DustSettings settings;
            settings.tree.depth = cloud == Cloud::cellBorders ? 11 : 9;
            settings.tree.policy = policy;
            SCOPED_TRACE(described(settings, cloud, 50'000));
            moment.fill(cloud, 50'000, random);
            ASSERT_NO_FATAL_FAILURE(pair.compare(moment, settings));
        }
}

/// A world whose cells have no exact edge rounds coordinates as the CPU does, and one that follows its vehicle moves in
/// the same steps.
TEST(GpuOctree, FollowsTheVehicleInWorldsOfAnyEdge) {
    Pair pair;
    CloudMoment moment;
    std::mt19937 random(58);
    for (int set = 0; set < 30; ++set) {
        DustSettings settings;
        settings.tree.depth = 5 + set % 5;
        settings.worldEdgeMetres = 10 + 0.37 * set;
        settings.opacity = set % 2 == 0 ? draw::OpacityFrom::dust : draw::OpacityFrom::age;
        settings.tree.policy = static_cast<OpacityPolicy>(set % 3);
        moment.fill(clouds[static_cast<std::size_t>(set) % clouds.size()], 300, random);
        moment.state.vehicle.position = {0.9 * set, 0.1 * set, -0.3 * set};
        for (float& x : moment.dust.x) x += 0.8f * static_cast<float>(set);
        SCOPED_TRACE("set " + std::to_string(set));
        ASSERT_NO_FATAL_FAILURE(pair.compare(moment, settings));
    }
}

TEST(GpuOctree, ForgetsACloudThatShrinks) {
    Pair pair;
    CloudMoment moment;
    std::mt19937 random(59);
    const DustSettings settings;
    for (const std::size_t count : {9'000u, 10u, 0u, 5'000u, 1u, 0u, 20'000u}) {
        SCOPED_TRACE(count);
        moment.fill(Cloud::trail, count, random);
        ASSERT_NO_FATAL_FAILURE(pair.compare(moment, settings));
    }
}

TEST(GpuOctree, KeepsTheMaximaUntilTheyBeginAgain) {
    CloudMoment moment;
    std::mt19937 random(60);
    GpuOctree gpu(TestMoment::device());
    PuffUpload upload(TestMoment::device());
    const StageClock untimed;
    DustSettings settings;
    settings.worldGrows = false;
    std::uint32_t voxels = 0, clipped = 0;
    for (const std::size_t count : {2'000u, 300u, 0u}) {
        moment.fill(Cloud::outside, count, random);
        gpu.build(upload.upload(moment.dust), settings, glm::dvec3(0), count == 2'000, untimed);
        voxels = std::max(voxels, gpu.readNumbers().voxels);
        clipped = std::max(clipped, gpu.readNumbers().clipped);
        EXPECT_EQ(gpu.readNumbers().maximumVoxels, voxels);
        EXPECT_EQ(gpu.readNumbers().maximumClipped, clipped);
    }
    EXPECT_GT(clipped, 100u);
    gpu.build(upload.upload(moment.dust), settings, glm::dvec3(0), true, untimed);
    EXPECT_EQ(gpu.readNumbers().maximumVoxels, 0u);
}

/// With shared colours and individual ones.
TEST(GpuOctreeDust, DrawsThePicturesOfTheCpu) {
    std::mt19937 random(61);
    for (const bool coloured : {false, true})
        for (const Render render : {Render::billboards, Render::circles, Render::cubes, Render::raycast})
            for (const draw::SortKind sort : {draw::SortKind::radix, draw::SortKind::none}) {
                CloudMoment moment;
                moment.fill(Cloud::trail, 800, random);
                moment.dust.keepOneColour(!coloured);
                for (std::size_t i = 0; i < moment.dust.red.size(); ++i) {
                    moment.dust.red[i] = static_cast<float>(i % 7) / 7;
                    moment.dust.green[i] = moment.dust.blue[i] = 0.5f;
                }
                DustSettings settings;
                settings.tree.policy = render == Render::cubes ? OpacityPolicy::max : OpacityPolicy::accumulate;
                settings.render = render;
                settings.sort = sort;
                settings.opacity = render == Render::circles ? draw::OpacityFrom::age : draw::OpacityFrom::dust;
                OctreeDust cpu = onCpu(settings);
                GpuOctreeDust gpu(settings);
                cpu.prepare(moment.scene, {}, TestMoment::device());
                gpu.prepare(moment.scene, {}, TestMoment::device());
                const pictures::Image expected = moment.updateAndDraw(cpu), got = moment.updateAndDraw(gpu);
                EXPECT_EQ(moment.draw(gpu).pixels, got.pixels);
                float largest = 0, alpha = 0;
                for (std::size_t i = 0; i < got.pixels.size(); ++i)
                    for (int channel = 0; channel < 4; ++channel) {
                        largest = std::max(largest, std::abs(got.pixels[i][channel] - expected.pixels[i][channel]));
                        alpha += got.pixels[i].a;
                    }
                EXPECT_LT(largest, 2e-5f) << renders.wordOf(render) << ", " << draw::sortKinds.wordOf(sort);
                EXPECT_GT(alpha, 1000);
            }
}

TEST(GpuOctreeDust, ReadsNothingBackInAFrame) {
    CloudMoment moment;
    std::mt19937 random(62);
    GpuOctreeDust method{DustSettings()};
    method.prepare(moment.scene, {}, TestMoment::device());
    moment.fill(Cloud::trail, 3'000, random);
    (void)moment.updateAndDraw(method);
    int inFrames = 0;
    for (int frame = 0; frame < 5; ++frame) {
        const gpu::CountedReadBacks readBacks;
        method.update(moment.frame());
        method.draw(moment.frame(), moment.layer());
        inFrames += readBacks.count();
    }
    EXPECT_EQ(inFrames, 0);
    const gpu::CountedReadBacks readBacks;
    EXPECT_GT(method.tree().readVoxels().size(), 100u);
    EXPECT_GT(readBacks.count(), 0);
}

/// Each pass sees what the passes before it have written, on every device.
TEST(GpuOctreeDust, EndsEveryPassWithABarrier) {
    CloudMoment moment;
    std::mt19937 random(63);
    GpuOctreeDust method{DustSettings()};
    method.prepare(moment.scene, {}, TestMoment::device());
    moment.fill(Cloud::trail, 1'000, random);
    const gpu::WatchedBarriers watched;
    method.update(moment.frame());
    EXPECT_GT(watched.dispatches(), 20);
    EXPECT_EQ(watched.missing(), 0);
}

class VoxelCollector final : public VolumeVisitor {
 public:
    void puffs(const Puffs&) override { ADD_FAILURE() << "puffs"; }
    void grid(const GridVolume&) override { ADD_FAILURE() << "grid"; }
    void octree(const OctreeVolume& volume) override { voxels.assign(volume.voxels.begin(), volume.voxels.end()); }
    std::vector<OctreeVoxel> voxels;
};

TEST(GpuOctreeDust, HandsOverTheVoxelsAndFactsOfTheCpu) {
    CloudMoment moment;
    std::mt19937 random(64);
    moment.fill(Cloud::trail, 2'000, random);
    for (const OpacityPolicy policy : {OpacityPolicy::max, OpacityPolicy::accumulate}) {
        DustSettings settings;
        settings.tree.policy = policy;
        OctreeDust cpu = onCpu(settings);
        GpuOctreeDust gpu(settings);
        MethodInfo info;
        declareDust(info);
        std::array<VoxelCollector, 2> collectors;
        std::array<Facts, 2> facts{Facts(info.facts, FactOver::lastFrame), Facts(info.facts, FactOver::lastFrame)};
        std::array<Facts, 2> maxima{Facts(info.facts, FactOver::maximumOfFrames),
                                    Facts(info.facts, FactOver::maximumOfFrames)};
        const std::array<Method*, 2> methods{&cpu, &gpu};
        for (std::size_t i = 0; i < 2; ++i) {
            methods[i]->prepare(moment.scene, {}, TestMoment::device());
            methods[i]->update(moment.frame());
            methods[i]->volume(moment.frame(), collectors[i]);
            methods[i]->report(moment.frame(), facts[i]);
            methods[i]->report(moment.frame(), maxima[i]);
        }
        ASSERT_EQ(collectors[0].voxels.size(), collectors[1].voxels.size());
        for (std::size_t i = 0; i < collectors[0].voxels.size(); ++i) {
            const OctreeVoxel &a = collectors[0].voxels[i], &b = collectors[1].voxels[i];
            ASSERT_EQ(std::tie(a.x, a.y, a.z, a.level, a.ageSeconds), std::tie(b.x, b.y, b.z, b.level, b.ageSeconds));
            ASSERT_FLOAT_EQ(a.extinctionPerMetre, b.extinctionPerMetre);
        }
        for (const char* name : {"mass_kept", "mass_lost"})
            EXPECT_NEAR(std::get<double>(facts[0].value(name).value()), std::get<double>(facts[1].value(name).value()),
                        1e-7);
        EXPECT_EQ(maxima[0].value("clipped"), maxima[1].value("clipped"));
        EXPECT_EQ(maxima[0].value("world_edge_max"), maxima[1].value("world_edge_max"));
    }
}

TEST(GpuOctreeDust, NamesPositionsThatAreNotNumbers) {
    CloudMoment moment;
    std::mt19937 random(65);
    moment.fill(Cloud::trail, 100, random);
    moment.dust.y[7] = std::numeric_limits<float>::quiet_NaN();
    GpuOctreeDust method{DustSettings()};
    method.prepare(moment.scene, {}, TestMoment::device());
    method.update(moment.frame());
    MethodInfo info;
    declareDust(info);
    Facts facts(info.facts, FactOver::lastFrame);
    EXPECT_THROW(method.report(moment.frame(), facts), SimulationError);
}

TEST(GpuOctreeDust, RefusesWhatOnlyTheCpuHas) {
    DustSettings settings;
    settings.sort = draw::SortKind::quicksort;
    EXPECT_THROW(GpuOctreeDust{settings}, InputError);
    settings = {};
    settings.crossFade = true;
    EXPECT_THROW(GpuOctreeDust{settings}, InputError);
    settings = {};
    settings.keepSeconds = 0.1;
    EXPECT_THROW(GpuOctreeDust{settings}, InputError);
}

}  // namespace
}  // namespace dustbench::octree
