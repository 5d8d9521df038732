// Checks that pictures of sparse volumes equal those of dense ones and of the plain march.
#include "methods/volume/sparse/sparse_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <random>

#include "methods/kit/raycast/plain_march.h"
#include "methods/kit/raycast/raycast_test_canvas.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/volume/sparse/sparse_test_grid.h"

namespace dustbench::volume {
namespace {

using raycast::Backend, raycast::Canvas, raycast::RaycastSettings, raycast::TestGrid, raycast::maximumDifference,
    raycast::meanAlpha;
using testing::HasSubstr;

/// Separate lumps in a box that is mostly clear; some touch its faces.
TestGrid blobs(std::mt19937& random, const glm::ivec3& cells, bool burning) {
    std::uniform_real_distribution<double> share(0, 1);
    struct Blob {
        glm::dvec3 middle;
        double radius;
    };
    std::vector<Blob> all;
    all.reserve(10);
    for (int i = 0; i < 9; ++i)
        all.push_back(
            {glm::dvec3(share(random), share(random), share(random)) * glm::dvec3(cells), 1 + 4 * share(random)});
    // A single cell, seen by samples on all eight sides.
    all.push_back({glm::floor(glm::dvec3(cells) * glm::dvec3(share(random), share(random), share(random))) + 0.5, 0.4});
    TestGrid grid(cells, 0.1, glm::dvec3(cells) * -0.05, [](const glm::dvec3&) { return 0.0; });
    for (std::size_t i = 0; i < grid.density.size(); ++i) {
        const int n = static_cast<int>(i);
        const glm::dvec3 at = glm::dvec3(n % cells.x, n / cells.x % cells.y, n / cells.x / cells.y) + 0.5;
        for (const Blob& blob : all)
            if (glm::distance(at, blob.middle) < blob.radius) grid.density[i] = static_cast<float>(0.2 + share(random));
        if (burning) grid.reaction.push_back(static_cast<float>(share(random)));
    }
    return grid;
}

class SparsePictureOn : public testing::TestWithParam<Backend> {
 protected:
    pictures::Image sparse(Canvas& canvas, const TestGrid& grid, const glm::ivec3& firstCell,
                           RaycastSettings settings) {
        settings.backend = GetParam();
        MemoryLedger ledger;
        SparseMoment moment(ledger, "test");
        fill(moment, grid, firstCell);
        SparsePicture picture(Canvas::device(), settings, canvas.lights, ledger);
        picture.upload(moment);
        return canvas.TestCanvas::picture([&](const gpu::Layer& layer) { picture.draw(canvas.view, layer); });
    }
    pictures::Image dense(Canvas& canvas, const TestGrid& grid, RaycastSettings settings) {
        settings.backend = GetParam();
        return canvas.picture(grid, settings);
    }
    /// Where OpenGL is hardware, its textures interpolate in 256 steps; a sparse volume does not.
    static double tolerance() { return GetParam() == Backend::cpu || Canvas::device().isSoftware() ? 1e-5 : 4e-3; }
};
INSTANTIATE_TEST_SUITE_P(Backends, SparsePictureOn, testing::Values(Backend::cpu, Backend::gl),
                         [](const auto& test) { return test.param == Backend::cpu ? "Cpu" : "Gl"; });

TEST_P(SparsePictureOn, EqualsThatOfTheDenseVolume) {
    Canvas canvas;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> centred(-1, 1);
    int seen = 0;
    const int sets = GetParam() == Backend::cpu ? 48 : 16;
    for (int set = 0; set < sets; ++set) {
        const glm::ivec3 cells(20 + random() % 40, 17 + random() % 30, 9 + random() % 60);
        const glm::ivec3 firstCell(static_cast<int>(random() % 300) - 150, static_cast<int>(random() % 5000) - 4990,
                                   static_cast<int>(random() % 16) - 8);
        const TestGrid grid = blobs(random, cells, set % 3 == 1);
        RaycastSettings settings = raycast::settingsOf(GetParam());
        settings.extinctionPerMetre = 2;
        settings.shadowCells = set % 4 == 3 ? 2 + set % 3 : 0;
        settings.asymmetry = set % 8 == 3 ? 0.5f : 0;
        settings.jitter = set % 5 != 2;
        settings.stepCells = set % 6 == 4 ? 1.7 : set % 6 == 5 ? 0.25 : 0.5;
        settings.skipEmpty = set % 7 != 6;
        settings.stopAlpha = set % 3 == 2 ? 0.8 : 1;
        // Near, within, and so far away that a packet sees many cells.
        const double distance = set % 4 == 0 ? 0.8 : set % 4 == 1 ? 40 : 7;
        const glm::dvec3 eye = distance * glm::normalize(glm::dvec3(centred(random), centred(random), centred(random)));
        canvas.lookFrom(eye, -eye);
        canvas.setWall(distance, set % 2 == 0 ? 50 : 0);
        const pictures::Image expected = dense(canvas, grid, settings);
        EXPECT_LT(maximumDifference(sparse(canvas, grid, firstCell, settings), expected), tolerance()) << "set " << set;
        seen += meanAlpha(expected) > 1e-4 ? 1 : 0;
    }
    EXPECT_GT(seen, 3 * sets / 4);
}

TEST_P(SparsePictureOn, EqualsThePlainMarch) {
    Canvas canvas;
    std::mt19937 random(8);
    canvas.setWall(4.3, 60);
    const TestGrid grid = blobs(random, {31, 27, 40}, true);
    RaycastSettings settings = raycast::settingsOf(GetParam());
    settings.extinctionPerMetre = 5;
    for (const glm::dvec3& eye : {glm::dvec3(3, 2, 4), glm::dvec3(0.3, -0.2, 0.5)}) {
        const glm::dvec3 forward = glm::normalize(-eye);
        canvas.lookFrom(eye, forward);
        const pictures::Image image = sparse(canvas, grid, {-17, 3, -9}, settings);
        const raycast::PlainVolume volume{
            grid.shown(), settings, raycast::cloudColour(settings.smokeColour, canvas.lights), {}};
        const double spacing = grid.spacingMetres;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const glm::dvec3 along = glm::normalize(glm::dvec3(canvas.view.rayDirection(x + 0.5, y + 0.5)));
                const glm::dvec4 plain = plainMarch(volume, {(eye - grid.originMetres) / spacing, along,
                                                             canvas.wallAt(x) / glm::dot(along, forward) / spacing,
                                                             raycast::plainJitter(x, image.height - 1 - y)});
                for (int channel = 0; channel < 4; ++channel)
                    ASSERT_NEAR(image.at(x, y)[channel], plain[channel], 3e-5) << x << ',' << y;
            }
    }
}

TEST_P(SparsePictureOn, DrawsTheLatestMomentAndTheSameAgain) {
    Canvas canvas;
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    MemoryLedger ledger;
    SparseMoment burning(ledger, "test"), smoke(ledger, "test"), clear(ledger, "test");
    fill(burning, raycast::lumps(true), {1, 2, 3});
    fill(smoke, raycast::lumps(false), {-1, -2, -3});
    fill(clear, TestGrid({5, 6, 7}, 0.1, {0, 0, 0}, [](const glm::dvec3&) { return 0.0; }), {0, 0, 0});
    SparsePicture picture(Canvas::device(), settingsOf(GetParam()), canvas.lights, ledger);
    const auto shown = [&] {
        return canvas.TestCanvas::picture([&](const gpu::Layer& layer) { picture.draw(canvas.view, layer); });
    };
    EXPECT_EQ(meanAlpha(shown()), 0);
    picture.upload(burning);
    const pictures::Image first = shown();
    EXPECT_GT(picture.primitives(), 100);
    EXPECT_EQ(shown().pixels, first.pixels);
    picture.upload(clear);
    EXPECT_EQ(meanAlpha(shown()), 0);
    EXPECT_EQ(picture.primitives(), 0);
    picture.upload(smoke);
    EXPECT_LT(maximumDifference(shown(), dense(canvas, raycast::lumps(false), settingsOf(GetParam()))), tolerance());
    picture.upload(burning);
    EXPECT_EQ(shown().pixels, first.pixels);
}

TEST(SparsePicture, OnTheCpuIsTheSameOnOneThreadAndOnMore) {
    Canvas canvas;
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    std::vector<pictures::Image> images;
    for (const int threads : {1, 2, 5}) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            MemoryLedger ledger;
            SparseMoment moment(ledger, "test");
            fill(moment, raycast::lumps(true), {-5, 6, 7});
            RaycastSettings settings = raycast::settingsOf(Backend::cpu);
            settings.shadowCells = 2;
            SparsePicture picture(Canvas::device(), settings, canvas.lights, ledger);
            picture.upload(moment);
            images.push_back(
                canvas.TestCanvas::picture([&](const gpu::Layer& layer) { picture.draw(canvas.view, layer); }));
        });
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    EXPECT_EQ(images[0].pixels, images[2].pixels);
}

TEST(SparsePicture, RefusesWhatItDoesNotShow) {
    for (const raycast::Renderer renderer :
         {raycast::Renderer::slices, raycast::Renderer::splat, raycast::Renderer::isosurface}) {
        RaycastSettings settings;
        settings.renderer = renderer;
        EXPECT_THAT(inputError([&] { requireSparse(settings); }), HasSubstr("with storage=sparse, allowed: raycast"));
    }
    for (const raycast::Filter filter : {raycast::Filter::nearest, raycast::Filter::cubic}) {
        RaycastSettings settings;
        settings.filter = filter;
        EXPECT_EQ(inputError([&] { requireSparse(settings); }), "parameter filter: got " +
                                                                    std::string(raycast::filters.wordOf(filter)) +
                                                                    " with storage=sparse, allowed: linear");
    }
    EXPECT_NO_THROW(requireTreesFit(128'000'000, 128'000'000));
    EXPECT_EQ(
        inputError([] { requireTreesFit(128'100'000, 128'000'000); }),
        "storage=sparse: the volume takes 128.1 MB on the GPU, allowed: 128.0 MB, the largest storage buffer of this "
        "OpenGL driver; backend=cpu has no such limit");
}

TEST(SparsePicture, RefusesLightInTooManyBlocks) {
    MemoryLedger ledger;
    SparseMoment moment(ledger, "test");
    const TestGrid one({1, 1, 1}, 1, {0, 0, 0}, [](const glm::dvec3&) { return 1.0; });
    fill(moment, one, {0, 0, 0});
    moment.cells = {1000, 1000, 1000};
    RaycastSettings settings;
    settings.shadowCells = 2;
    SparsePicture picture(Canvas::device(), settings, {}, ledger);
    EXPECT_THAT(inputError([&] { picture.upload(moment); }),
                HasSubstr("the box has 1.25e+08 blocks of shadow_cells=2 for its light, allowed: 3.2e+07"));
    moment.cells = {5000, 10, 10};
    settings.backend = Backend::gl;
    SparsePicture onGpu(Canvas::device(), settings, {}, ledger);
    EXPECT_THAT(inputError([&] { onGpu.upload(moment); }), HasSubstr("2500 blocks of shadow_cells=2 along an axis"));
}

}  // namespace
}  // namespace dustbench::volume
