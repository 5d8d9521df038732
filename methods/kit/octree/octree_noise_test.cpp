// Tests the noise of voxels: that of the particle which represents the voxel, wherever the particle is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "methods/kit/octree/cell_kernel.h"
#include "methods/kit/octree/octree_dust.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::octree {
namespace {

/// Makes a voxel for each particle; no two particles may share one.
class SoloBuilder final : public OctreeBuilder {
 public:
    std::int64_t build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                       Octree& tree) override {
        const CellKernel<LevelRule::age> kernel(store, lattice, settings);
        std::vector<CellEntry> entries;
        for (std::uint32_t i = 0; i < store.size(); ++i) {
            const ParticleCell cell = kernel(i);
            const std::uint64_t code = static_cast<std::uint64_t>(cell.brickCode) << 12 | cell.localCode;
            const CellEntry entry(code, static_cast<int>(cell.rise), i);
            entries.emplace_back(entry.voxelCode(), entry.rise(), i);
        }
        std::ranges::sort(entries, {}, &CellEntry::place);
        tree.clear(settings.depth);
        tree.setVoxels(entries.size(), false);
        for (std::uint32_t k = 0; k < entries.size(); ++k) {
            tree.mutableVoxels()[k] = entries[k];
            tree.makeNode(entries[k].code(), entries[k].rise()).voxel = k + 1;
        }
        return 0;
    }
};

/// Thin dust on a lattice of a metre, with a vehicle at the origin.
class SparseDust : public TestMoment {
 public:
    SparseDust() : TestMoment(216, 80, 60, {0, 3, 17}, {0, 0, -17}) {
        std::mt19937 random(4);
        std::uniform_real_distribution<float> uniform(0, 0.3f);
        for (std::size_t i = 0; i < dust.size(); ++i) {
            dust.serial[i] = i;
            const std::size_t column = i % 6, row = i / 6 % 6, layer = i / 36;
            dust.x[i] = static_cast<float>(column) - 3 + 0.1f + uniform(random);
            dust.y[i] = static_cast<float>(row) + 0.1f + uniform(random);
            dust.z[i] = static_cast<float>(layer) - 3 + 0.1f + uniform(random);
            dust.radius[i] = 0.6f;
            dust.opacity[i] = 0.02f;
            dust.lifetime[i] = 4;
            dust.age[i] = 0.5f;
        }
    }
};

/// The picture of the dust as voxels; `shown` receives a copy of the noise by voxel.
pictures::Image drawnVoxels(SparseDust& moment, Render render, const draw::NoiseSettings& noise,
                            std::vector<draw::NoisePlace>* shown = nullptr, bool fades = false) {
    DustSettings settings;
    settings.render = render;
    settings.noise = noise;
    settings.crossFade = fades;
    OctreeDust method(settings, [](MemoryLedger&) { return std::make_unique<SoloBuilder>(); });
    method.prepare(moment.scene, {}, SparseDust::device());
    method.update(moment.frame());
    if (shown) shown->assign(method.shown().noise.begin(), method.shown().noise.end());
    return moment.draw(method);
}

double summedDepth(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum -= std::log1p(-static_cast<double>(pixel.a));
    return sum;
}

double rmsOfAlpha(const pictures::Image& a, const pictures::Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        sum += std::pow(static_cast<double>(a.pixels[i].a - b.pixels[i].a), 2);
    return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

TEST(OctreeNoise, KeepsTheMeanOpacityHoweverVoxelsAreDrawn) {
    SparseDust moment;
    for (const Render render : {Render::billboards, Render::circles, Render::cubes, Render::raycast}) {
        const pictures::Image plain = drawnVoxels(moment, render, {}), noisy = drawnVoxels(moment, render, {1, 0.4f});
        EXPECT_NEAR(summedDepth(noisy) / summedDepth(plain), 1, 0.08) << static_cast<int>(render);
        EXPECT_GT(rmsOfAlpha(noisy, plain), 0.002) << static_cast<int>(render);
    }
}

TEST(OctreeNoise, MovesWithTheParticlesWhileTheVoxelsStay) {
    const draw::NoiseSettings noise{1, 0.4f};
    SparseDust moment;
    std::vector<draw::NoisePlace> before, after;
    const pictures::Image first = drawnVoxels(moment, Render::billboards, noise, &before);
    const glm::vec3 step(0.004f, 0, 0.002f);  // within the same voxels
    for (std::size_t i = 0; i < moment.dust.size(); ++i) moment.dust.x[i] += step.x, moment.dust.z[i] += step.z;
    const pictures::Image second = drawnVoxels(moment, Render::billboards, noise, &after);
    ASSERT_EQ(before.size(), moment.dust.size());
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_FLOAT_EQ(before[i].metres, 0.4f * 0.6f);
        ASSERT_LT(glm::distance(after[i].place - before[i].place, -step / before[i].metres), 1e-3f);
    }
    EXPECT_GT(rmsOfAlpha(first, second), 0);
    EXPECT_LT(rmsOfAlpha(first, second), 0.002) << "steadily";
}

TEST(OctreeNoise, IsKeptByVoxelsThatFade) {
    const draw::NoiseSettings noise{0.7f, 0.4f};
    SparseDust moment;
    EXPECT_LT(rmsOfAlpha(drawnVoxels(moment, Render::billboards, noise),
                         drawnVoxels(moment, Render::billboards, noise, nullptr, true)),
              1e-6);
}

}  // namespace
}  // namespace dustbench::octree
