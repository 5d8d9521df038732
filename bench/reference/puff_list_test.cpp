#include "bench/reference/puff_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "bench/reference/test_clouds.h"

namespace dustbench::reference {
namespace {

scene::View smallView() {
    scene::View view;
    view.width = 61;
    view.height = 47;
    view.camera.eye = {1, 2, 3};
    view.camera.target = {-3, 1, -4};
    view.camera.verticalFieldOfView = 1.3;
    return view;
}

// The essential property: the depth outside a footprint is within its bound, wherever the puff is.
TEST(PuffList, FootprintsLeaveOutNothingThatCounts) {
    const scene::View view = smallView();
    const CameraRays rays(view);
    constexpr double neglected = 1e-7;
    std::int64_t inside = 0, outside = 0;
    for (std::uint64_t k = 0; k < 400; ++k) {
        const auto a = maths::uniform4(3, 1, k), b = maths::uniform4(3, 2, k);
        MemoryLedger ledger;
        particles::ParticleStore store(ledger);
        // From right at the eye to 40 m away on all sides, behind included; radii 1 cm to 1.5 m.
        const float reach = 40 * b[2];
        const glm::vec3 offset(maths::centred(a[0]), maths::centred(a[1]), maths::centred(a[2]));
        test::add(store, glm::vec3(view.camera.eye) + reach * offset, std::exp(-4.6f + 5 * b[0]), 0.9f * b[1]);
        const auto puffs = preparePuffs(store, rays, 1, neglected);
        const auto depths = test::plainDepths(store, view, skyDistances(view));
        for (int y = 0; y < view.height; ++y) {
            Columns columns{0, 0};
            if (!puffs.empty() && y >= puffs[0].firstRow && y < puffs[0].endRow)
                columns = columnsOf(puffs[0], rowGeometry(puffs[0], rays.rowSlope(y)), rays.rowSlope(y), rays);
            for (int x = 0; x < view.width; ++x) {
                const double depth = depths[static_cast<std::size_t>(y * view.width + x)];
                const bool within = x >= columns.first && x < columns.end;
                if (!within) {
                    ASSERT_LE(depth, neglected * (1 + 1e-9)) << "puff " << k << " at " << x << ", " << y;
                }
                ++(within ? inside : outside);
            }
        }
    }
    // Footprints cover a large part of the image, but leave out most of it.
    EXPECT_GT(outside, 3 * inside);
    EXPECT_GT(inside, 20'000);
}

TEST(PuffList, RowGeometryGivesTheRaysDistanceAndFoot) {
    const scene::View view = smallView();
    const CameraRays rays(view);
    for (std::uint64_t k = 0; k < 200; ++k) {
        const auto a = maths::uniform4(4, 1, k);
        Puff puff{};
        puff.centre = 40.0 * glm::dvec3(maths::centred(a[0]), maths::centred(a[1]), maths::centred(a[2]));
        if (k == 0) puff.centre = {5, 0, 0};  // on the camera's own x axis
        const int x = static_cast<int>(k) % view.width, y = static_cast<int>(a[3] * 46);
        const glm::dvec3 ray(rays.columnSlope(x), rays.rowSlope(y), 1);
        const RowGeometry row = rowGeometry(puff, ray.y);
        const double u = ray.x - row.x0;
        const double squareB = (row.gamma * u * u + row.kappa) / glm::dot(ray, ray);
        EXPECT_NEAR(std::sqrt(squareB), glm::length(glm::cross(puff.centre, glm::normalize(ray))), 1e-12 * 40);
        EXPECT_NEAR((row.footAtZero + row.footPerSlope * ray.x) / glm::length(ray),
                    glm::dot(puff.centre, glm::normalize(ray)), 1e-12 * 40);
    }
}

TEST(PuffList, LeavesOutWhatCannotBeSeen) {
    const scene::View view = smallView();
    const CameraRays rays(view);
    MemoryLedger ledger;
    particles::ParticleStore store(ledger);
    const glm::vec3 eye(view.camera.eye), ahead(rays.direction(30, 23));
    test::add(store, eye + 10.0f * ahead, 1, 0.5f);
    test::add(store, eye - 10.0f * ahead, 1, 0.5f);
    test::add(store, eye + 10.0f * ahead, 0, 0.5f);
    test::add(store, eye + 10.0f * ahead, 1, 0);
    const auto puffs = preparePuffs(store, rays, 0.25, 1e-8);
    ASSERT_EQ(puffs.size(), 1u);
    EXPECT_EQ(puffs[0].index, 0u);
    EXPECT_DOUBLE_EQ(puffs[0].opticalDepth, std::log(2) / 4);
    EXPECT_DOUBLE_EQ(puffs[0].deviationMetres, 0.5);
    const double edge = puffs[0].reachMetres / 0.5;
    EXPECT_NEAR(puffs[0].opticalDepth * std::exp(-edge * edge / 2), 1e-8, 1e-20);
}

TEST(PuffList, NamesTheParticleThatIsNoPuff) {
    const CameraRays rays(smallView());
    const auto messageOf = [&](auto spoil) -> std::string {
        MemoryLedger ledger;
        auto store = test::ball(ledger, 1, 10, {0, 0, 0}, 3, 0.5f);
        spoil(store);
        try {
            std::ignore = preparePuffs(store, rays, 1, 1e-9);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    using Store = particles::ParticleStore;
    const float nan = std::nanf("");
    const auto naming = ::testing::HasSubstr("particle 107 ");
    EXPECT_EQ(messageOf([](Store&) {}), "");
    EXPECT_THAT(messageOf([&](Store& store) { store.x[7] = nan; }), naming);
    EXPECT_THAT(messageOf([&](Store& store) { store.y[7] = HUGE_VALF; }), naming);
    EXPECT_THAT(messageOf([&](Store& store) { store.z[7] = nan; }), naming);
    EXPECT_THAT(messageOf([&](Store& store) { store.radius[7] = nan; }), naming);
    EXPECT_THAT(messageOf([&](Store& store) { store.radius[7] = -1; }), naming);
    EXPECT_THAT(messageOf([&](Store& store) { store.opacity[7] = nan; }), naming);
    EXPECT_THAT(messageOf([&](Store& store) { store.opacity[7] = 1; }), naming);
    EXPECT_THAT(messageOf([&](Store& store) { store.opacity[7] = -0.1f; }), naming);
}

}  // namespace
}  // namespace dustbench::reference
