#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/contract/scene.h"
#include "methods/kit/raycast/plain_march.h"
#include "methods/kit/raycast/raycast_test_canvas.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::raycast {
namespace {

class GridRaycastOn : public ::testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, GridRaycastOn, ::testing::Values(Backend::cpu, Backend::gl),
                         [](const auto& test) { return test.param == Backend::cpu ? "Cpu" : "Gl"; });

TEST_P(GridRaycastOn, ShowsAHomogeneousBoxAsTheAnalyticImage) {
    Canvas canvas;
    const TestGrid box({12, 7, 9}, 0.5, {-3, -2, -2}, [](const glm::dvec3&) { return 0.8; });
    const glm::dvec3 maximum = box.originMetres + box.spacingMetres * glm::dvec3(box.cells);
    RaycastSettings settings = settingsOf(GetParam());
    settings.extinctionPerMetre = 0.6;
    const auto red = static_cast<double>(cloudColour(settings.smokeColour, canvas.lights).all().r);
    struct Look {
        glm::dvec3 eye, along;
        std::optional<double> wall;
    };
    for (const Look& look : {Look{{0.3, 0.2, 9}, {0, 0, -1}, {}}, Look{{6, 4, 7}, {-6, -4, -7}, {}},
                             Look{{0.1, 0.2, 0.3}, {1, 0.3, 0.2}, {}}, Look{{0, 0, 2.55}, {0, 0, -1}, {}},
                             Look{{0.3, 0.2, 9}, {0, 0, -1}, 8.3}, Look{{0, 0, 1}, {0.2, 0.1, -1}, 1.234},
                             Look{{0, 0, 9}, {0, 0, 1}, {}}, Look{{0, 0, 9}, {0, 0, -1}, 5}}) {
        canvas.lookFrom(look.eye, look.along);
        canvas.setWall(look.wall, look.wall ? 40 : 0);
        const pictures::Image image = canvas.picture(box, settings);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const double alpha = -std::expm1(-0.48 * canvas.lengthWithin(x, y, box.originMetres, maximum));
                ASSERT_NEAR(image.at(x, y).a, alpha, 1e-3) << x << ',' << y << " from " << look.eye.x;
                ASSERT_NEAR(image.at(x, y).r, alpha * red, 1e-3);
            }
    }
}

/// GPUs weight the texels of a filtered sample in steps of 1/256; llvmpipe weights them in floats.
double gpuTolerance(double inSoftware) {
    return Canvas::device().isSoftware() ? inSoftware : 5e-3;
}

TEST(GridRaycast, ShowsTheSameOnCpuAndGpu) {
    Canvas canvas;
    canvas.setWall(9.5, 70);
    for (const bool burning : {false, true}) {
        const TestGrid grid = lumps(burning);
        for (const Filter filter : {Filter::nearest, Filter::linear, Filter::cubic})
            // Close enough that a packet's neighbours fit a window, too far for that, and inside the grid.
            for (const glm::dvec3& eye : {glm::dvec3(3, 2, 4), glm::dvec3(-25, 9, 30), glm::dvec3(0.3, 0.2, 0.1)}) {
                canvas.lookFrom(eye, -eye);
                RaycastSettings settings = settingsOf(Backend::cpu);
                settings.filter = filter;
                settings.extinctionPerMetre = 4;
                settings.shadowCells = eye.z < 10 ? 3 : 0;
                const pictures::Image image = canvas.picture(grid, settings);
                settings.backend = Backend::gl;
                const pictures::Image onGpu = canvas.picture(grid, settings);
                // For a sample on the border of two cells, floats may find the other cell.
                if (filter == Filter::nearest)
                    EXPECT_LT(pixelsApart(image, onGpu, 2e-4), 0.005 * 96 * 72) << eye.x << burning;
                else
                    EXPECT_LT(maximumDifference(image, onGpu), gpuTolerance(2e-4)) << eye.x << burning;
                EXPECT_GT(meanAlpha(image), 0.001);
            }
    }
}

TEST(GridRaycast, ShowsWhatLiesOnTheGpuAsWhatIsUploaded) {
    Canvas canvas;
    canvas.setWall(9.5, 70);
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    for (const bool burning : {false, true})
        for (const Renderer renderer : {Renderer::raycast, Renderer::slices}) {
            const TestGrid grid = lumps(burning);
            const auto onGpu = [&](const std::vector<float>& values) {
                gpu::Texture texture = gpu::Texture::make3D(Canvas::device(), "test", gpu::Format::r32F, grid.cells.x,
                                                            grid.cells.y, grid.cells.z);
                texture.write(std::span<const float>(values));
                return texture;
            };
            gpu::Texture density = onGpu(grid.density), reaction = onGpu(burning ? grid.reaction : grid.density);
            const ShownTextures textures{grid.cells, grid.spacingMetres, grid.originMetres, &density,
                                         burning ? &reaction : nullptr};
            RaycastSettings settings = settingsOf(Backend::gl);
            settings.renderer = renderer;
            settings.extinctionPerMetre = 4;
            settings.shadowCells = 3;
            MemoryLedger ledger;
            GridRaycast raycast(Canvas::device(), settings, canvas.lights, ledger);
            ASSERT_TRUE(raycast.takesTextures());
            raycast.take(textures);
            const pictures::Image image =
                canvas.TestCanvas::picture([&](const gpu::Layer& layer) { raycast.draw(canvas.view, layer); });
            EXPECT_LT(maximumDifference(image, canvas.picture(grid, settings)), gpuTolerance(2e-4)) << burning;
            EXPECT_GT(meanAlpha(image), 0.001);

            // The last grid counts, whether uploaded or taken.
            raycast.upload(TestGrid(grid.cells, 1, {0, 0, 0}, [](const glm::dvec3&) { return 0.0; }).shown());
            raycast.upload(grid.shown());
            EXPECT_EQ(canvas.TestCanvas::picture([&](const gpu::Layer& l) { raycast.draw(canvas.view, l); }).pixels,
                      canvas.picture(grid, settings).pixels);
            std::vector<float> negative = grid.density;
            negative[5] = -0.25f;
            density.write(std::span<const float>(negative));
            EXPECT_NE(inputError([&] { raycast.take(textures); }).find("-0.25 in cell (5, 0, 0)"), std::string::npos);
        }
}

/// Random cells; at least every fourth brick has no density.
TestGrid randomGrid(std::mt19937& random, bool burning) {
    std::uniform_real_distribution<float> share(0, 1);
    TestGrid grid({19, 14, 22}, 0.3, {-2.85, -2.1, -3.3}, [](const glm::dvec3&) { return 0.0; });
    const auto clear = random() % 4;
    for (std::size_t i = 0; i < grid.density.size(); ++i) {
        const std::size_t x = i % 19, y = i / 19 % 14, z = i / 19 / 14;
        if ((x / 4 + 3 * (y / 4) + 5 * (z / 4)) % 4 != clear && share(random) < 0.7f) grid.density[i] = share(random);
        if (burning) grid.reaction.push_back(1.2f * share(random));
    }
    return grid;
}

TEST_P(GridRaycastOn, EqualsThePlainMarch) {
    Canvas canvas;
    canvas.setWall(4.3, 60);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> centred(-1, 1);
    const glm::dvec3 forwardTo(0.2, -0.1, 0.3);
    const double limit = GetParam() == Backend::cpu ? 3e-5 : gpuTolerance(3e-5);
    for (int set = 0; set < 16; ++set) {
        const TestGrid grid = randomGrid(random, set % 2 == 1);
        RaycastSettings settings = settingsOf(GetParam());
        settings.filter = set >= 12 ? Filter::nearest : set % 4 < 2 ? Filter::linear : Filter::cubic;
        settings.shadowCells = set % 3;
        settings.asymmetry = set % 3 == 2 ? 0.6f : set % 3 == 1 ? -0.3f : 0;
        settings.stepCells = 0.3 + 0.1 * (set % 12);
        settings.jitter = set != 5;
        settings.extinctionPerMetre = 0.6;
        const double distance = set == 3 ? 0.5 : 5;
        const glm::dvec3 eye = distance * glm::dvec3(centred(random), centred(random), centred(random));
        canvas.lookFrom(eye, forwardTo - eye);
        const pictures::Image image = canvas.picture(grid, settings);

        MemoryLedger ledger;
        LightVolume light(settings, canvas.lights.toSun, ledger);
        if (settings.shadowCells > 0) light.set(grid.shown());
        const PlainVolume volume{grid.shown(), settings,
                                 cloudColour(settings.smokeColour, canvas.lights, settings.asymmetry), light.values()};
        const glm::dvec3 forward = glm::normalize(forwardTo - eye), inCells = (eye - grid.originMetres) / 0.3;
        int apart = 0;  // pixels with a sample on the border of two cells, where floats find the other one
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const glm::dvec3 along = glm::normalize(glm::dvec3(canvas.view.rayDirection(x + 0.5, y + 0.5)));
                const double end = canvas.wallAt(x) / glm::dot(along, forward) / 0.3;
                const double jitter = settings.jitter ? plainJitter(x, image.height - 1 - y) : 0;
                const glm::dvec4 plain = plainMarch(volume, {inCells, along, end, jitter});
                const glm::dvec4 off = glm::abs(glm::dvec4(image.at(x, y)) - plain);
                if (settings.filter == Filter::nearest && glm::any(glm::greaterThan(off, glm::dvec4(limit)))) {
                    ++apart;
                    continue;
                }
                for (int channel = 0; channel < 4; ++channel)
                    ASSERT_LT(off[channel], limit)
                        << "set " << set << " pixel " << x << ',' << y << " channel " << channel;
            }
        EXPECT_LT(apart, 0.005 * image.width * image.height) << "set " << set;
    }
}

TEST_P(GridRaycastOn, LosesNothingBySkippingAndLittleByStoppingEarly) {
    Canvas canvas;
    for (const bool burning : {false, true})
        for (const glm::dvec3& eye : {glm::dvec3(2, 2, 4), glm::dvec3(-0.6, 0.2, 0.1)}) {
            canvas.lookFrom(eye, glm::dvec3(0.1, 0, 0) - eye);
            RaycastSettings settings = settingsOf(GetParam());
            settings.extinctionPerMetre = 12;
            const pictures::Image image = canvas.picture(lumps(burning), settings);
            settings.skipEmpty = false;
            EXPECT_LT(maximumDifference(image, canvas.picture(lumps(burning), settings)), 5e-5);
            settings.stopAlpha = 0.9;
            const pictures::Image stopped = canvas.picture(lumps(burning), settings);
            double lost = 0;
            for (std::size_t i = 0; i < image.pixels.size(); ++i)
                lost = std::max(lost, static_cast<double>(image.pixels[i].a - stopped.pixels[i].a));
            EXPECT_LT(lost, 0.1 + 1e-5);
            EXPECT_GT(lost, 0.01);
        }
}

TEST_P(GridRaycastOn, ErrorFallsWithTheStep) {
    Canvas canvas;
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    const TestGrid grid = lumps(false);
    RaycastSettings settings = settingsOf(GetParam());
    settings.jitter = false;
    settings.extinctionPerMetre = 4;
    settings.filter = Filter::cubic;  // without kinks between cells
    settings.stepCells = 1.0 / 16;
    const pictures::Image fine = canvas.picture(grid, settings);
    const auto error = [&](double step) {
        settings.stepCells = step;
        const pictures::Image image = canvas.picture(grid, settings);
        double squares = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            squares += std::pow(static_cast<double>(image.pixels[i].a - fine.pixels[i].a), 2);
        return std::sqrt(squares);
    };
    const double coarse = error(4), middle = error(2), small = error(1);
    EXPECT_LT(middle, 0.5 * coarse);
    EXPECT_LT(small, 0.5 * middle);
}

TEST_P(GridRaycastOn, KeepsTheMeanDepthOfALinearFieldWhateverTheJitterAndTheFilter) {
    Canvas canvas;
    canvas.view.camera.verticalFieldOfView = 0.05;
    const double edge = 0.25;
    canvas.lookFrom({0.1, 0, 60}, {0, 0, -1});
    const TestGrid grid({20, 20, 12}, edge, {-2.5, -2.5, -1.5},
                        [](const glm::dvec3& at) { return 2 + 0.3 * at.x - 0.2 * at.y + 0.5 * at.z; });
    for (const bool jitter : {false, true})
        for (const Filter filter : {Filter::linear, Filter::cubic}) {
            RaycastSettings settings = settingsOf(GetParam());
            settings.jitter = jitter;
            settings.filter = filter;
            settings.extinctionPerMetre = 0.5;
            double sum = 0;
            const pictures::Image image = canvas.picture(grid, settings);
            for (const glm::vec4& pixel : image.pixels) sum -= std::log1p(-static_cast<double>(pixel.a));
            // Averaged over the picture, x is 0.1 and y, z are 0.
            EXPECT_NEAR(sum / static_cast<double>(image.pixels.size()), 0.5 * 3 * 2.03, 3e-3) << jitter;
        }
}

TEST_P(GridRaycastOn, CubicFilterSpreadsASingleCellWithoutGoingBelowZero) {
    Canvas canvas;
    canvas.lookFrom({0.1, 0.2, 3}, {0, 0, -1});
    TestGrid grid({9, 9, 9}, 0.25, {-1.125, -1.125, -1.125}, [](const glm::dvec3&) { return 0.0; });
    grid.density[4 + 9 * (4 + 9 * 4)] = 1;
    RaycastSettings settings = settingsOf(GetParam());
    settings.jitter = false;
    const auto sumOf = [&](Filter filter, double& maximum) {
        settings.filter = filter;
        double sum = 0;
        for (const glm::vec4& pixel : canvas.picture(grid, settings).pixels) {
            EXPECT_GE(pixel.a, 0);
            sum -= std::log1p(-static_cast<double>(pixel.a));
            maximum = std::max(maximum, static_cast<double>(pixel.a));
        }
        return sum;
    };
    double sharp = 0, smooth = 0;
    const double linear = sumOf(Filter::linear, sharp), cubic = sumOf(Filter::cubic, smooth);
    EXPECT_NEAR(cubic / linear, 1, 0.02);
    EXPECT_LT(smooth, 0.6 * sharp);
}

TEST_P(GridRaycastOn, ShowsWhatBurnsByTheTable) {
    Canvas canvas;
    canvas.lookFrom({0, 0, 5}, {0, 0, -1});
    TestGrid grid({8, 8, 8}, 0.5, {-2, -2, -2}, [](const glm::dvec3&) { return 1.0; });
    RaycastSettings settings = settingsOf(GetParam());
    settings.extinctionPerMetre = 0.25;
    settings.fire = TransferFunction({{0.2, {0, 0, 0}, 1}, {0.7, {2, 1, 0.5f}, 3}});
    for (const double reaction : {0.0, 0.45, 1.0}) {
        grid.reaction.assign(grid.density.size(), static_cast<float>(reaction));
        const glm::vec4 pixel = canvas.picture(grid, settings).at(48, 36);
        const double burning = std::clamp((reaction - 0.2) / 0.5, 0.0, 1.0), alpha = -std::expm1(-(1 + 2 * burning));
        const glm::dvec3 reflected(cloudColour(settings.smokeColour, canvas.lights).all());
        EXPECT_NEAR(pixel.a, alpha, 2e-3);
        EXPECT_NEAR(pixel.r, alpha * (reflected.r + 2 * burning), 1e-2);
        EXPECT_NEAR(pixel.b, alpha * (reflected.b + 0.5 * burning), 5e-3);
    }
}

TEST_P(GridRaycastOn, ShowsTheSideAwayFromTheSunByTheSkyAlone) {
    Canvas canvas;
    canvas.lights.toSun = {0, 0, 1};
    const TestGrid box({8, 8, 16}, 0.25, {-1, -1, -2}, [](const glm::dvec3&) { return 1.0; });
    RaycastSettings settings = settingsOf(GetParam());
    settings.extinctionPerMetre = 20;
    settings.shadowCells = 1;
    const Reflected reflected = cloudColour(settings.smokeColour, canvas.lights);
    canvas.lookFrom({0, 0, -6}, {0, 0, 1});
    EXPECT_NEAR(canvas.picture(box, settings).at(48, 36).g, reflected.ambient.g, 2e-3);
    // There and back: ∫ σ·e^(−2σt) dt = ½, up to the size of the light's texels.
    canvas.lookFrom({0, 0, 6}, {0, 0, -1});
    settings.extinctionPerMetre = 2;
    const double there = -std::expm1(-8.0), back = -std::expm1(-16.0) / 2;
    EXPECT_NEAR(canvas.picture(box, settings).at(48, 36).g,
                static_cast<double>(reflected.ambient.g) * there + static_cast<double>(reflected.sun.g) * back, 1e-2);
}

TEST_P(GridRaycastOn, DrawsTheLatestGridAndTheSameAgain) {
    Canvas canvas;
    canvas.lookFrom({0, 0, 6}, {0, 0, -1});
    MemoryLedger ledger;
    GridRaycast raycast(Canvas::device(), settingsOf(GetParam()), canvas.lights, ledger);
    const auto picture = [&] {
        return canvas.TestCanvas::picture([&](const gpu::Layer& layer) { raycast.draw(canvas.view, layer); });
    };
    EXPECT_EQ(meanAlpha(picture()), 0);
    TestGrid clear({5, 6, 7}, 0.1, {0, 0, 0}, [](const glm::dvec3&) { return 0.0; });
    const TestGrid one({1, 1, 1}, 1, {-0.5, -0.5, -0.5}, [](const glm::dvec3&) { return 1.0; });
    raycast.upload(lumps(true).shown());
    const pictures::Image burning = picture();
    EXPECT_GT(raycast.primitives(), 100);
    EXPECT_EQ(picture().pixels, burning.pixels);
    raycast.upload(clear.shown());
    EXPECT_EQ(meanAlpha(picture()), 0);
    EXPECT_EQ(raycast.primitives(), 0);
    raycast.upload(one.shown());
    EXPECT_NEAR(picture().at(48, 36).a, -std::expm1(-1.0), 1e-3);
    clear.density[5 * 6 * 3 + 5 * 2 + 4] = std::nanf("");
    EXPECT_EQ(inputError([&] { raycast.upload(clear.shown()); }),
              "shown grid: got a density of nan in cell (4, 2, 3), allowed: 0 or more");
    clear.density[5 * 6 * 3 + 5 * 2 + 4] = -1e-9f;
    EXPECT_EQ(inputError([&] { raycast.upload(clear.shown()); }),
              "shown grid: got a density of -1e-09 in cell (4, 2, 3), allowed: 0 or more");
    EXPECT_EQ(meanAlpha(picture()), 0);
    raycast.upload(lumps(true).shown());
    EXPECT_EQ(picture().pixels, burning.pixels);
}

TEST_P(GridRaycastOn, EndsFromSoFarThatFloatsDoNotTellStepsApart) {
    Canvas canvas;
    canvas.view.camera.verticalFieldOfView = 1e-7;
    for (const double metres : {1e6, 1e8, 1e12}) {
        canvas.lookFrom({0, 0, metres}, {0, 0, -1});
        for (const glm::vec4& pixel : canvas.picture(lumps(true), settingsOf(GetParam())).pixels)
            ASSERT_TRUE(pixel.a >= 0 && pixel.a <= 1);
    }
}

TEST(GridRaycast, OnTheCpuIsTheSameOnOneThreadAndOnMore) {
    Canvas canvas;
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    std::vector<pictures::Image> images;
    for (const int threads : {1, 2, 5}) {
        tbb::task_arena arena(threads);
        arena.execute([&] { images.push_back(canvas.picture(lumps(true), settingsOf(Backend::cpu))); });
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    EXPECT_EQ(images[0].pixels, images[2].pixels);
}

TEST(CloudColour, IsThatOfTheSharedDust) {
    scene::Scene scene;
    const glm::vec3 colour = cloudColour(scene.dustAlbedo, scene.lights).all(), dust = scene::dustColour(scene);
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(colour[channel], dust[channel], 1e-6);
}

}  // namespace
}  // namespace dustbench::raycast
