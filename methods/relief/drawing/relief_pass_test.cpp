// The picture of a relief, compared pixel by pixel with the reference surface_hit.h.
#include "methods/relief/drawing/relief_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>
#include <vector>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/maths/srgb.h"
#include "methods/relief/surface/surface_hit.h"

namespace dustbench::relief {
namespace {

constexpr int width = 120, height = 90;

/// Random hills; or needles: single texels that rise to the face from a plane above the bottom, a hard case for floats.
std::shared_ptr<const scene::Relief> reliefOf(int columns, int rows, bool needles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0, 1);
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = columns;
    relief->rows = rows;
    for (int i = 0; i < columns * rows; ++i)
        relief->depth.push_back(needles ? (any(random) < 0.03f ? 0.0f : 0.95f) : any(random));
    relief->colour.assign(relief->depth.size(), glm::vec3(0.5f));
    return relief;
}

struct Shown {
    std::vector<float> depth;  ///< rows from the bottom
    pictures::Image colour;
};

class ReliefPassTest : public testing::Test {
 protected:
    ReliefPassTest() {
        scene_.lights.hazePerMetre = 0;
        panel_.sizeMetres = {2, 1.5};
        panel_.depthMetres = 0.3;
        panel_.toParent = glm::rotate(glm::translate(glm::dmat4(1), {3, 1.5, -2}), 0.7, {0.2, 1, 0.1});
        panel_.relief = reliefOf(37, 29, false, 4);
    }

    /// Returns a view from a place in the panel's frame.
    scene::View viewFrom(const glm::dvec3& eye, const glm::dvec3& target = {0, 0, -0.15}) const {
        scene::View view;
        view.width = width;
        view.height = height;
        view.camera.eye = glm::dvec3(panel_.toParent * glm::dvec4(eye, 1));
        view.camera.target = glm::dvec3(panel_.toParent * glm::dvec4(target, 1));
        view.camera.nearMetres = 0.01;
        return view;
    }

    Shown show(const scene::View& view, const ReliefStyle& style) {
        MemoryLedger ledger;
        WornSurface surface(*panel_.relief, ledger);
        const DepthPyramid pyramid(surface.depths(), ledger);
        ReliefPass pass(device_, scene_, panel_, pyramid, style);
        static_cast<void>(pass.upload(surface, pyramid, surface.takeChanged()));
        return show(view, pass);
    }

    Shown show(const scene::View& view, ReliefPass& pass, const CarShadow* shadow = nullptr) {
        gpu::Texture far = gpu::Texture::make2D(device_, "far", gpu::Format::depth32F, width, height);
        far.write(std::span<const float>(std::vector<float>(width * height, 0.0f)));
        SceneWithReliefs target(device_, width, height);
        target.begin(far);
        pass.draw(view, panel_.toParent, shadow);
        return {target.layer().sceneDepth().readFloats(), draw::readBack(target.layer().colour())};
    }

    /// Returns the reversed depth of the first hit of the ray through a pixel; 0 if there is none.
    double expectedDepth(const DepthMap& map, const scene::View& view, int x, int y) const {
        const glm::dmat4 toPanel = glm::inverse(panel_.toParent);
        const glm::dvec3 eye(toPanel * glm::dvec4(view.camera.eye, 1));
        const glm::dvec3 ray(view.rayDirection(x + 0.5, y + 0.5));
        const glm::dvec3 way(toPanel * glm::dvec4(ray, 0));
        const glm::dvec3 low(-panel_.sizeMetres / 2.0, -panel_.depthMetres), high(panel_.sizeMetres / 2.0, 0);
        const glm::dvec3 a = (low - eye) / way, b = (high - eye) / way;
        const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
        const double enter = std::max({near.x, near.y, near.z, 0.0}), leave = std::min({far.x, far.y, far.z});
        if (enter >= leave) return 0;
        const auto texels = [&](double t) {
            const glm::dvec3 at = eye + t * way;
            return glm::dvec3((at.x / panel_.sizeMetres.x + 0.5) * map.columns() - 0.5,
                              (at.y / panel_.sizeMetres.y + 0.5) * map.rows() - 0.5, -at.z / panel_.depthMetres);
        };
        const auto share = firstHit(map, texels(enter), texels(leave));
        if (!share) return 0;
        const double distance = enter + *share * (leave - enter);
        const glm::dvec3 axis = glm::normalize(view.camera.target - view.camera.eye);
        return view.camera.nearMetres / (distance * glm::dot(axis, ray));
    }

    struct Compared {
        int seen = 0, missed = 0, differ = 0;
    };
    /// Tolerance: a millimetre per metre, and the same again for a ray that grazes a hilltop, unless given.
    Compared compare(const scene::View& view, const ReliefStyle& style, double tolerance = 1e-3) {
        MemoryLedger ledger;
        const DepthMap map(*panel_.relief, ledger);
        const Shown shown = show(view, style);
        Compared result;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double expected = expectedDepth(map, view, x, y);
                const double got =
                    static_cast<double>(shown.depth[static_cast<std::size_t>((height - 1 - y) * width + x)]);
                if (expected > 0) ++result.seen;
                if (expected > 0 && got == 0)
                    ++result.missed;
                else if (std::abs(got - expected) > tolerance * std::max(got, expected))
                    ++result.differ;
            }
        return result;
    }

    gpu::Device& device_ = draw::TestCanvas::device();
    scene::Scene scene_;
    scene::Panel panel_;
};

TEST_F(ReliefPassTest, TheSafeMarchShowsWhatTheOracleSeesFromAllSides) {
    for (const bool needles : {false, true})
        for (const glm::dvec3& eye :
             {glm::dvec3(0, 0, 2), glm::dvec3(1.5, 0.4, 0.5), glm::dvec3(-2, 1, 0.15), glm::dvec3(0.3, -1.6, 0.05),
              glm::dvec3(2.5, 0.1, -0.1), glm::dvec3(0.4, 0.2, -2), glm::dvec3(0.1, 0.05, 0.2)}) {
            panel_.relief = reliefOf(37, 29, needles, 9);
            const Compared found = compare(viewFrom(eye), {});
            EXPECT_GT(found.seen, 300) << eye.x << ' ' << eye.y << ' ' << eye.z;
            // Rays along an edge of the plate or a hill may be rounded to either side.
            EXPECT_LE(found.missed + found.differ, found.seen / 100) << eye.x << ' ' << eye.y << ' ' << eye.z;
        }
}

// Close to a wall and along it, triangles of the plate are clipped: no pixel may be lost at their edges or get a wrong
// colour, such as that of a coarser mipmap.
TEST_F(ReliefPassTest, TheMarchAndTheMeshShowTheSameWhereThePlateReachesBesideThePicture) {
    auto flat = std::make_shared<scene::Relief>();
    flat->columns = flat->rows = 128;
    for (int row = 0; row < 128; ++row)
        for (int column = 0; column < 128; ++column) {
            const bool brick = column / 16 % 2 == 0;
            flat->depth.push_back(brick ? 0.0f : 0.4f);
            flat->colour.emplace_back(brick ? glm::vec3(0.6f, 0.1f, 0.1f) : glm::vec3(0.9f));
        }
    panel_.relief = flat;
    panel_.sizeMetres = {4, 2};
    panel_.depthMetres = 0.12;
    for (int n = 0; n < 24; n += 4) {
        const scene::View view = viewFrom({-2.3 + 0.01 * n, 0.05 + 0.003 * n, 0.12 + 0.002 * n}, {0.004 * n, 0, -0.03});
        const Compared found = compare(view, {});
        ASSERT_GT(found.seen, width * height / 5);
        EXPECT_LE(found.missed, 2) << n;  // rays along an edge of the plate
        ReliefStyle mesh;
        mesh.march = March::mesh;
        const Shown a = show(view, ReliefStyle{}), b = show(view, mesh);
        int different = 0;
        for (std::size_t i = 0; i < a.colour.pixels.size(); ++i)
            different += glm::distance(a.colour.pixels[i], b.colour.pixels[i]) > 0.1f ? 1 : 0;
        EXPECT_LE(different, found.seen / 200) << n;
    }
}

// From 3 cm to 1 m in front of a wall, in all directions: most of the plate is outside the picture or behind the eye,
// so its triangles are clipped.
TEST_F(ReliefPassTest, NoPixelIsLostWhereThePlateReachesBehindTheEye) {
    auto stripes = std::make_shared<scene::Relief>();
    stripes->columns = stripes->rows = 128;
    for (int i = 0; i < 128 * 128; ++i) stripes->depth.push_back(i / 16 % 2 == 0 ? 0.0f : 0.4f);
    stripes->colour.assign(stripes->depth.size(), glm::vec3(0.5f));
    panel_.relief = stripes;
    panel_.sizeMetres = {4, 2};
    panel_.depthMetres = 0.12;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    Compared all;
    for (int n = 0; n < 60; ++n) {
        const glm::dvec3 eye(2.5 * any(random), 1.2 * any(random), std::pow(10.0, -0.75 + 0.75 * any(random)));
        const glm::dvec3 target = eye + glm::dvec3(any(random), any(random), -0.3 * (1 + any(random)));
        const Compared found = compare(viewFrom(eye, target), {});
        EXPECT_LE(found.missed, 3) << n;  // rays along an edge of the plate
        all.seen += found.seen, all.missed += found.missed, all.differ += found.differ;
    }
    EXPECT_GT(all.seen, 60 * width * height / 4);
    // GPUs place the plate's edges in steps of 1/256 of a pixel.
    EXPECT_LE(all.missed + all.differ, all.seen / (device_.isSoftware() ? 10'000 : 5'000));
}

// Within the plate: a camera in a pit sees its floor and walls; within the solid it sees through it.
TEST_F(ReliefPassTest, AnEyeWithinThePlateSeesThePitItIsIn) {
    auto pit = std::make_shared<scene::Relief>();
    pit->columns = pit->rows = 40;
    for (int row = 0; row < 40; ++row)
        for (int column = 0; column < 40; ++column)
            pit->depth.push_back(column > 8 && column < 32 && row > 8 && row < 32 ? 0.9f : 0.1f);
    pit->colour.assign(pit->depth.size(), glm::vec3(0.5f));
    panel_.relief = pit;
    for (const glm::dvec3& target : {glm::dvec3(0, 0, -0.3), glm::dvec3(1, 0.2, -0.2), glm::dvec3(-0.5, 1, 0)}) {
        const Compared found = compare(viewFrom({0.05, 0.02, -0.12}, target), {});
        EXPECT_GT(found.seen, width * height / 3);
        EXPECT_LE(found.missed + found.differ, found.seen / 100);
    }
    const Shown inside = show(viewFrom({0.8, 0.6, -0.15}), ReliefStyle{});
    for (const glm::vec4& pixel : inside.colour.pixels) ASSERT_EQ(pixel, glm::vec4(0));
    for (const float depth : inside.depth) ASSERT_EQ(depth, 0.0f);
}

// Wear in one corner after another: the picture equals that of a new pass that gets the whole surface.
TEST_F(ReliefPassTest, UploadsOfWhatChangedShowTheWholeSurfaceAndAreSmall) {
    panel_.relief = reliefOf(64, 48, false, 6);
    for (const March march : {March::safe, March::paper}) {
        MemoryLedger ledger;
        WornSurface surface(*panel_.relief, ledger);
        DepthPyramid pyramid(surface.depths(), ledger);
        ReliefStyle style;
        style.march = march;
        ReliefPass often(device_, scene_, panel_, pyramid, style);
        const std::size_t all = often.upload(surface, pyramid, surface.takeChanged());
        std::size_t few = 0;
        for (const auto& [u, v] : {std::pair(2.0f, 45.0f), {60.2f, 3.1f}, {31.0f, 20.0f}, {0.0f, 0.0f}}) {
            surface.scatter(std::vector<Impact>{{u, v, 4, DepthMap::bottom}});
            u < 10 ? surface.layOn() : surface.takeOff();  // a block that has become nearer must not be skipped
            const TexelRectangle changed = surface.takeChanged();
            pyramid.update(surface.depths(), changed);
            few = often.upload(surface, pyramid, changed);
            EXPECT_LT(few, all / 2);
        }
        EXPECT_EQ(often.upload(surface, pyramid, {}), 0u);
        ReliefPass once(device_, scene_, panel_, pyramid, style);
        static_cast<void>(once.upload(surface, pyramid, {0, 0, 64, 48}));
        const scene::View view = viewFrom({0.4, 0.5, 1.2});
        const Shown a = show(view, often), b = show(view, once);
        EXPECT_EQ(a.depth, b.depth);
        EXPECT_EQ(a.colour.pixels, b.colour.pixels);
    }
}

TEST_F(ReliefPassTest, ThePapersMarchMissesNeedlesThatTheSafeOneFinds) {
    panel_.relief = reliefOf(64, 48, true, 2);
    const scene::View grazing = viewFrom({1.6, 0.2, 0.12});
    ReliefStyle paper;
    paper.march = March::paper;
    const Compared byPaper = compare(grazing, paper), bySafe = compare(grazing, {});
    EXPECT_GT(byPaper.missed + byPaper.differ, 5 * (bySafe.missed + bySafe.differ + 1));
}

TEST_F(ReliefPassTest, ThePapersMarchConvergesToTheOracleWithItsSteps) {
    const scene::View view = viewFrom({0.8, 0.3, 0.9});
    int last = width * height;
    for (const int steps : {8, 32, 512}) {
        ReliefStyle style;
        style.march = March::paper;
        style.linearSteps = steps;
        style.binarySteps = 12;
        const Compared found = compare(view, style);
        EXPECT_LT(found.missed + found.differ, last) << steps;
        last = found.missed + found.differ;
    }
    EXPECT_LT(last, 60);
}

// Between texels the mesh has two triangles where the surface is bilinear: smooth hills differ little.
TEST_F(ReliefPassTest, TheMeshShowsTheSurfaceWithItsRimAndBack) {
    auto hills = std::make_shared<scene::Relief>();
    hills->columns = 60;
    hills->rows = 45;
    for (int row = 0; row < 45; ++row)
        for (int column = 0; column < 60; ++column)
            hills->depth.push_back(0.5f + 0.4f * std::sin(0.3f * static_cast<float>(column)) *
                                              std::cos(0.25f * static_cast<float>(row)));
    hills->colour.assign(hills->depth.size(), glm::vec3(0.5f));
    panel_.relief = hills;
    ReliefStyle mesh;
    mesh.march = March::mesh;
    for (const glm::dvec3& eye : {glm::dvec3(0, 0, 2), glm::dvec3(1.5, 0.4, 0.5), glm::dvec3(-1.8, 0.3, -0.1),
                                  glm::dvec3(0.3, -1.6, 0.05), glm::dvec3(0.4, 0.2, -2)}) {
        const scene::View view = viewFrom(eye);
        const Compared found = compare(view, mesh, 0.01);
        ASSERT_GT(found.seen, 300);
        EXPECT_LE(found.missed + found.differ, found.seen * 3 / 100) << eye.x << ' ' << eye.y << ' ' << eye.z;
        // The colours are those of the march.
        const Shown marched = show(view, ReliefStyle{}), drawn = show(view, mesh);
        int different = 0;
        for (std::size_t i = 0; i < drawn.colour.pixels.size(); ++i)
            different += glm::distance(drawn.colour.pixels[i], marched.colour.pixels[i]) > 0.05f ? 1 : 0;
        EXPECT_LE(different, found.seen * 3 / 100) << eye.x << ' ' << eye.y << ' ' << eye.z;
    }
}

TEST_F(ReliefPassTest, AFlatReliefIsLitLikeAPlane) {
    auto flat = std::make_shared<scene::Relief>();
    flat->columns = flat->rows = 8;
    flat->depth.assign(64, 0.5f);
    flat->colour.assign(64, glm::vec3(0.5f));
    panel_.relief = flat;
    const glm::dvec3 normal(panel_.toParent[2]);
    scene_.lights.toSun = glm::vec3(glm::normalize(normal + glm::dvec3(0, 0.3, 0)));
    const Shown shown = show(viewFrom({0, 0, 2}, {0, 0, 0}), {});
    const scene::Lights& lights = scene_.lights;
    const float facing = glm::dot(lights.toSun, glm::vec3(normal));
    const glm::vec3 ground = 0.52f * scene_.dustAlbedo * (lights.sun * std::max(lights.toSun.y, 0.0f) + lights.ambient);
    const glm::vec3 around = glm::mix(ground, lights.ambient, 0.5f + 0.5f * static_cast<float>(normal.y));
    const float albedo = maths::decodeSrgb(188.0f / 255);  // 0.5 as eight bits store it
    const glm::vec3 expected = albedo * (lights.sun * facing + around);
    const glm::vec4 got = shown.colour.at(width / 2, height / 2);
    EXPECT_LT(glm::distance(glm::vec3(got), expected), 2e-3f);
    EXPECT_EQ(got.a, 1.0f);
}

// A car of one triangle between the sun and the middle of a flat relief.
TEST_F(ReliefPassTest, TheCarShadesWhatIsBehindItAndNothingElse) {
    auto flat = std::make_shared<scene::Relief>();
    flat->columns = flat->rows = 8;
    flat->depth.assign(64, 0.0f);
    flat->colour.assign(64, glm::vec3(0.5f));
    panel_.relief = flat;
    panel_.toParent = glm::dmat4(1);
    scene_.lights.toSun = {0, 0, 1};
    auto triangle = std::make_shared<scene::Mesh>();
    triangle->positions = {{-0.3f, -0.3f, 0}, {0.3f, -0.3f, 0}, {0, 0.3f, 0}};
    triangle->normals.assign(3, {0, 0, 1});
    triangle->colours.assign(3, {1, 1, 1});
    triangle->indices = {0, 1, 2};
    auto speck = std::make_shared<scene::Mesh>(*triangle);
    for (glm::vec3& position : speck->positions) position *= 1e-3f;
    scene_.vehicle = scene::VehicleModel{{}, {"body", triangle}, {"wheel", speck}};
    scene::SceneState state;
    for (scene::WheelState& wheel : state.vehicle.wheels) wheel.hub = {0, 0, 0.2};
    CarShadow shadow(device_, scene_);
    const auto lightAt = [&](double z, const glm::vec2& place) {
        state.vehicle.position = {0, 0, z};
        shadow.draw(state);
        MemoryLedger ledger;
        WornSurface surface(*panel_.relief, ledger);
        const DepthPyramid pyramid(surface.depths(), ledger);
        ReliefStyle style;
        style.carShadow = true;
        ReliefPass pass(device_, scene_, panel_, pyramid, style);
        static_cast<void>(pass.upload(surface, pyramid, surface.takeChanged()));
        const scene::View view = viewFrom({0, 0, 2}, {0, 0, 0});
        const Shown shown = show(view, pass, &shadow);
        const glm::vec4 clip = view.worldToClip() * glm::vec4(place, 0, 1);
        return shown.colour
            .at(static_cast<int>((clip.x / clip.w * 0.5f + 0.5f) * width),
                static_cast<int>((0.5f - clip.y / clip.w * 0.5f) * height))
            .r;
    };
    const float lit = lightAt(0.5, {0.6f, 0.4f});
    EXPECT_LT(lightAt(0.5, {0, -0.1f}), 0.6f * lit);
    EXPECT_NEAR(lightAt(0.5, {-0.25f, 0.25f}), lit, 1e-3f);  // next to the triangle
    EXPECT_NEAR(lightAt(-0.5, {0, -0.1f}), lit, 1e-3f);      // the car is behind the panel
}

TEST_F(ReliefPassTest, ARidgeShadesTheGroundBehindIt) {
    auto ridge = std::make_shared<scene::Relief>();
    ridge->columns = 40;
    ridge->rows = 4;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 40; ++column) ridge->depth.push_back(column == 20 ? 0.0f : 1.0f);
    ridge->colour.assign(160, glm::vec3(0.5f));
    panel_.relief = ridge;
    scene_.lights.toSun = glm::vec3(glm::normalize(glm::dmat3(panel_.toParent) * glm::dvec3(1, 0, 0.6)));
    ReliefStyle unshaded;
    unshaded.shadow = false;
    const scene::View view = viewFrom({0, 0, 2});
    const Shown with = show(view, {}), without = show(view, unshaded);
    const auto darker = [&](double x) {
        const glm::vec4 clip = view.worldToClip() * glm::vec4(panel_.toParent * glm::dvec4(x, 0, -0.3, 1));
        const int column = static_cast<int>((clip.x / clip.w * 0.5f + 0.5f) * width);
        return with.colour.at(column, height / 2).r < without.colour.at(column, height / 2).r - 0.05f;
    };
    EXPECT_TRUE(darker(-0.15));  // the ridge is 0.3 m high: its shadow is 0.5 m long
    EXPECT_TRUE(darker(-0.35));
    EXPECT_FALSE(darker(-0.7));
    EXPECT_FALSE(darker(0.3));
}

}  // namespace
}  // namespace dustbench::relief
