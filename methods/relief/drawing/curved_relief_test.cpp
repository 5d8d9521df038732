// Reliefs on curved panels, compared with rays that are followed in small steps in double precision, and with the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/meshes/curved_panel.h"
#include "methods/relief/drawing/relief_pass.h"

namespace dustbench::relief {
namespace {

class CurvedRelief : public testing::Test {
 protected:
    static constexpr int width = 96, height = 72;

    CurvedRelief() {
        scene_.lights.hazePerMetre = 0;
        panel_.sizeMetres = {1.6, 1.2};
        panel_.depthMetres = 0.12;
        panel_.toParent = glm::rotate(glm::translate(glm::dmat4(1), {3, 1.5, -2}), 0.7, {0.2, 1, 0.1});
        // Smooth hills: rays that graze single texels would be rounded to either side.
        auto relief = std::make_shared<scene::Relief>();
        relief->columns = 32, relief->rows = 24;
        for (int row = 0; row < 24; ++row)
            for (int column = 0; column < 32; ++column) {
                relief->depth.push_back(0.5f + 0.45f * std::sin(0.7f * static_cast<float>(column)) *
                                                   std::cos(0.6f * static_cast<float>(row)));
                relief->colour.emplace_back(0.2f + 0.02f * static_cast<float>(column), 0.5f, 0.4f);
            }
        panel_.relief = relief;
    }

    [[nodiscard]] scene::View viewFrom(const glm::dvec3& eye) const {
        scene::View view;
        view.width = width, view.height = height;
        view.camera.eye = glm::dvec3(panel_.toParent * glm::dvec4(eye, 1));
        view.camera.target = glm::dvec3(panel_.toParent * glm::dvec4(0, 0, -0.1, 1));
        view.camera.nearMetres = 0.01;
        return view;
    }

    struct Picture {
        std::vector<float> depth;  ///< reversed, rows from the bottom
        pictures::Image colour;
    };
    Picture show(const scene::View& view, March march) {
        MemoryLedger ledger;
        WornSurface surface(*panel_.relief, ledger);
        const DepthPyramid pyramid(surface.depths(), ledger);
        ReliefStyle style;
        style.march = march;
        style.linearSteps = 15;
        ReliefPass pass(device_, scene_, panel_, pyramid, style);
        static_cast<void>(pass.upload(surface, pyramid, surface.takeChanged()));
        gpu::Texture far = gpu::Texture::make2D(device_, "far", gpu::Format::depth32F, width, height);
        far.write(std::span<const float>(std::vector<float>(width * height, 0.0f)));
        SceneWithReliefs target(device_, width, height);
        target.begin(far);
        pass.draw(view, panel_.toParent);
        return {target.layer().sceneDepth().readFloats(), draw::readBack(target.layer().colour())};
    }

    /// Distance along the ray through a pixel to the first point within the solid; 0 if there is none.
    [[nodiscard]] double expectedDistance(const DepthMap& map, const scene::View& view, int x, int y) const {
        const glm::dmat4 toPanel = glm::inverse(panel_.toParent);
        const glm::dvec3 eye(toPanel * glm::dvec4(view.camera.eye, 1));
        const glm::dvec3 way(toPanel * glm::dvec4(glm::dvec3(view.rayDirection(x + 0.5, y + 0.5)), 0));
        const meshes::PlateBounds box = meshes::boundsOf(panel_);
        const glm::dvec3 a = (box.low - eye) / way, b = (box.high - eye) / way;
        const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
        const double enter = std::max({near.x, near.y, near.z, 0.0}), leave = std::min({far.x, far.y, far.z});
        constexpr double step = 2e-3;
        const auto solid = [&](double t) {
            const glm::dvec3 at = meshes::toRelief(panel_, eye + t * way);
            if (std::abs(at.x) > panel_.sizeMetres.x / 2 || std::abs(at.y) > panel_.sizeMetres.y / 2 || at.z > 0 ||
                at.z < -panel_.depthMetres)
                return false;
            const double depth = map.depthAt((at.x / panel_.sizeMetres.x + 0.5) * map.columns() - 0.5,
                                             (at.y / panel_.sizeMetres.y + 0.5) * map.rows() - 0.5);
            return -at.z >= depth * panel_.depthMetres;
        };
        for (double t = enter; t < leave; t += step) {
            if (!solid(t)) continue;
            double before = std::max(t - step, enter), after = t;
            for (int halving = 0; halving < 20; ++halving)
                (solid(0.5 * (before + after)) ? after : before) = 0.5 * (before + after);
            return after;
        }
        return 0;
    }

    gpu::Device& device_ = draw::TestCanvas::device();
    scene::Scene scene_;
    scene::Panel panel_;
};

const glm::dvec2 bends[] = {{1, 0}, {-0.9, 0}, {0.8, 1.2}, {0.7, -0.9}};

TEST_F(CurvedRelief, TheMarchSeesWhatTheOracleSeesFromAllSides) {
    MemoryLedger ledger;
    const DepthMap map(*panel_.relief, ledger);
    for (const glm::dvec2& bend : bends) {
        panel_.curvaturePerMetre = bend;
        for (const glm::dvec3& eye : {glm::dvec3(0, 0, 1.6), glm::dvec3(1.3, 0.4, 0.5), glm::dvec3(-1.4, 0.2, 0.05),
                                      glm::dvec3(0.3, -1.3, 0.2), glm::dvec3(0.4, 0.2, -1.5)}) {
            const scene::View view = viewFrom(eye);
            const glm::dvec3 axis = glm::normalize(view.camera.target - view.camera.eye);
            const Picture shown = show(view, March::safe);
            int seen = 0, wrong = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const double distance = expectedDistance(map, view, x, y);
                    const double along = distance * glm::dot(axis, glm::dvec3(view.rayDirection(x + 0.5, y + 0.5)));
                    const auto got =
                        static_cast<double>(shown.depth[static_cast<std::size_t>((height - 1 - y) * width + x)]);
                    seen += distance > 0 ? 1 : 0;
                    const double expected = distance > 0 ? view.camera.nearMetres / along : 0;
                    wrong += std::abs(got - expected) > 5e-3 * std::max(got, expected) ? 1 : 0;
                }
            EXPECT_GT(seen, 300);
            // Rays that graze a hill or a rim may be rounded to either side.
            EXPECT_LE(wrong, seen / 60) << bend.x << ' ' << bend.y << " from " << eye.x << ' ' << eye.y << ' ' << eye.z;
        }
    }
}

TEST_F(CurvedRelief, TheMarchAndTheMeshShowTheSamePicture) {
    for (const glm::dvec2& bend : bends) {
        panel_.curvaturePerMetre = bend;
        for (const glm::dvec3& eye : {glm::dvec3(0.2, 0.1, 1.6), glm::dvec3(1.2, 0.5, 0.6)}) {
            const scene::View view = viewFrom(eye);
            const Picture march = show(view, March::safe), mesh = show(view, March::mesh);
            int seen = 0, different = 0;
            for (std::size_t i = 0; i < march.colour.pixels.size(); ++i) {
                seen += mesh.colour.pixels[i].a > 0 ? 1 : 0;
                different += glm::distance(march.colour.pixels[i], mesh.colour.pixels[i]) > 0.05f ? 1 : 0;
            }
            EXPECT_GT(seen, 1000);
            EXPECT_LE(different, seen / 30) << bend.x << ' ' << bend.y;
        }
    }
}

/// The face turns the light: a bulging wall's side towards the sun is lighter than the other.
TEST_F(CurvedRelief, TheSideTowardsTheSunIsLighter) {
    panel_.toParent = glm::dmat4(1);
    auto smooth = std::make_shared<scene::Relief>(*panel_.relief);
    std::ranges::fill(smooth->depth, 0.0f);
    std::ranges::fill(smooth->colour, glm::vec3(0.5f));
    panel_.relief = smooth;
    scene_.lights.toSun = glm::normalize(glm::vec3(1, 0.2f, 1));
    const auto leftAndRight = [&] {
        const pictures::Image image = show(viewFrom({0, 0, 1.6}), March::safe).colour;
        const auto at = [&](int x) { return image.pixels[static_cast<std::size_t>(height / 2 * width + x)].g; };
        return std::pair(at(width / 2 - 24), at(width / 2 + 24));
    };
    panel_.curvaturePerMetre = {0, 0};
    const auto flat = leftAndRight();
    EXPECT_NEAR(flat.first, flat.second, 1e-3);
    panel_.curvaturePerMetre = {1, 0};
    const auto bulging = leftAndRight();
    EXPECT_GT(bulging.second, 1.3f * bulging.first);
    panel_.curvaturePerMetre = {-1, 0};
    const auto hollow = leftAndRight();
    EXPECT_LT(1.3f * hollow.second, hollow.first);
}

}  // namespace
}  // namespace dustbench::relief
