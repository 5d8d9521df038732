#include "methods/kit/draw/shadow_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "methods/kit/draw/opaque_scene.h"
#include "methods/kit/draw/opaque_test_scene.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::draw {
namespace {

const glm::vec3 lowSun(-0.933013f, 0.258819f, -0.25f);

struct Cloud {
    std::vector<std::uint64_t> serial;
    std::vector<float> x, y, z, radius, opacity;

    void add(const glm::vec3& place, float metres, float peak) {
        serial.push_back(serial.size());
        x.push_back(place.x);
        y.push_back(place.y);
        z.push_back(place.z);
        radius.push_back(metres);
        opacity.push_back(peak);
    }
    [[nodiscard]] Puffs puffs() const {
        Puffs puffs;
        puffs.serial = serial;
        puffs.x = x;
        puffs.y = y;
        puffs.z = z;
        puffs.radius = radius;
        puffs.opacity = opacity;
        return puffs;
    }
    [[nodiscard]] double plainDepth(const glm::dvec3& at, const glm::dvec3& toSun) const {
        double sum = 0;
        for (std::size_t i = 0; i < serial.size(); ++i) {
            const glm::dvec3 toCentre = glm::dvec3(x[i], y[i], z[i]) - at;
            const double foot = glm::dot(toCentre, toSun), b = glm::length(glm::cross(toCentre, toSun));
            sum += maths::rayOpticalDepth(static_cast<double>(opacity[i]), static_cast<double>(radius[i]), b, foot, 0,
                                          1e9);
        }
        return sum;
    }
};

/// A trail 40 m long above the ground: puffs that grow and fade away from the car.
Cloud trail(std::size_t count) {
    Cloud cloud;
    for (std::size_t i = 0; i < count; ++i) {
        const auto a = maths::uniform4(3, 1, i), b = maths::uniform4(3, 2, i);
        const float share = a[0];
        cloud.add({-40 * share, 0.2f + 2.5f * share * a[1], 2 * (0.4f + share) * maths::centred(a[2])},
                  0.25f + 1.35f * share, 0.15f * (1 - share) * b[0]);
    }
    return cloud;
}

/// The shader's result, computed from the map read back.
double depthBy(const DustShadow& shadow, const glm::dvec3& at) {
    static constexpr int n = DustShadow::texels;
    const std::vector<float> map = shadow.columns().readFloats();
    const glm::dvec4 place = glm::dmat4(shadow.eyeToTexture({0, 0, 0})) * glm::dvec4(at, 1);
    const glm::dvec2 texel = glm::clamp(glm::dvec2(place) * static_cast<double>(n) - 0.5, 0.0, n - 1.001);
    const glm::ivec2 base(texel);
    const glm::dvec2 share = texel - glm::dvec2(base);
    glm::dvec3 column(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            for (int c = 0; c < 3; ++c)
                column[c] +=
                    (i ? share.x : 1 - share.x) * (j ? share.y : 1 - share.y) *
                    static_cast<double>(map[static_cast<std::size_t>(((base.y + j) * n + base.x + i) * 4 + c)]);
    if (column.x < 1e-4) return 0;
    const double middle = column.y / column.x, spread = std::max(column.z / column.x - middle * middle, 1e-6);
    return column.x * (0.5 - 0.5 * std::erf((place.z - middle) / std::sqrt(2 * spread)));
}

TEST(DustShadow, OfAPuffIsTheClosedForm) {
    Cloud cloud;
    cloud.add({3, 1, -2}, 1.2f, 0.7f);
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(lowSun));
    DustShadow shadow(TestCanvas::device(), lowSun);
    shadow.set(cloud.puffs());
    for (std::uint64_t k = 0; k < 200; ++k) {
        const auto a = maths::uniform4(3, 9, k);
        const glm::dvec3 at =
            glm::dvec3(3, 1, -2) + 3.0 * glm::dvec3(maths::centred(a[0]), maths::centred(a[1]), maths::centred(a[2]));
        ASSERT_NEAR(depthBy(shadow, at), cloud.plainDepth(at, toSun), 2e-3) << k;
    }
}

TEST(DustShadow, OfATrailIsTheClosedFormOnTheGroundAndNearItWithin) {
    const Cloud cloud = trail(1500);
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(lowSun));
    DustShadow shadow(TestCanvas::device(), lowSun);
    shadow.set(cloud.puffs());
    double worstBelow = 0, meanWithin = 0, deepest = 0;
    constexpr int points = 100;
    for (std::uint64_t k = 0; k < points; ++k) {
        const auto a = maths::uniform4(3, 9, k);
        const glm::dvec3 ground(-42 + 50 * static_cast<double>(a[0]), -1.5,
                                6 * static_cast<double>(maths::centred(a[1])));
        const glm::dvec3 within(-30 * static_cast<double>(a[0]), 2 * static_cast<double>(a[2]),
                                static_cast<double>(maths::centred(a[1])));
        deepest = std::max(deepest, cloud.plainDepth(ground, toSun));
        worstBelow = std::max(
            worstBelow, std::abs(std::exp(-depthBy(shadow, ground)) - std::exp(-cloud.plainDepth(ground, toSun))));
        meanWithin +=
            std::abs(std::exp(-depthBy(shadow, within)) - std::exp(-cloud.plainDepth(within, toSun))) / points;
    }
    EXPECT_GT(deepest, 0.5);
    EXPECT_LT(worstBelow, 0.02);
    EXPECT_LT(meanWithin, 0.04);
}

TEST(DustShadow, DarkensTheGroundBySunlightAloneAndOnlyWhereDustIsLit) {
    scene::Scene scene = test::underAHighSun();
    scene.lights.hazePerMetre = 0;
    Cloud cloud;
    cloud.add({0, 2, 0}, 2, 0.95f);
    // Straight down at the place where the puff's shadow falls.
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(scene.lights.toSun));
    const glm::dvec3 foot = glm::dvec3(0, 2, 0) - toSun * (2 / toSun.y);
    scene::View view = test::viewFrom(foot + glm::dvec3(0, 6, 0), foot, 64, 64);
    view.camera.up = {1, 0, 0};
    const auto picture = [&](bool lit, const Puffs& dust) {
        scene.lights.onDust = lit;
        OpaqueScene drawn(scene, TestCanvas::device(), 64, 64);
        drawn.draw({}, view, {}, dust);
        return readBack(drawn.colour());
    };
    const pictures::Image bare = picture(true, {}), unlit = picture(false, cloud.puffs());
    EXPECT_EQ(bare.pixels, picture(false, {}).pixels);
    EXPECT_EQ(unlit.pixels, bare.pixels);
    const pictures::Image shaded = picture(true, cloud.puffs());
    // ambient + T·sun·facing, against ambient + sun·facing.
    const double transmittance = std::exp(-cloud.plainDepth(foot, toSun)), facing = toSun.y;
    for (int c = 0; c < 3; ++c) {
        const double ambient = static_cast<double>(scene.lights.ambient[c]),
                     sun = static_cast<double>(scene.lights.sun[c]);
        const double expected = (ambient + transmittance * sun * facing) / (ambient + sun * facing);
        EXPECT_NEAR(shaded.at(32, 32)[c] / bare.at(32, 32)[c], expected, 0.02) << c;
    }
    EXPECT_LT(transmittance, 0.1);
}

TEST(DustShadow, APuffWithoutAPlaceChangesNothing) {
    Cloud cloud, lost;
    cloud.add({3, 1, -2}, 1.2f, 0.7f);
    lost.add({3, 1, -2}, 1.2f, 0.7f);
    lost.add({std::nanf(""), 1, 0}, 1, 0.5f);
    lost.add({1, std::numeric_limits<float>::infinity(), 0}, 1, 0.5f);
    DustShadow shadow(TestCanvas::device(), lowSun), other(TestCanvas::device(), lowSun);
    shadow.set(cloud.puffs());
    other.set(lost.puffs());
    EXPECT_EQ(shadow.columns().readFloats(), other.columns().readFloats());
}

TEST(DustShadow, NoDustLeavesAllLight) {
    DustShadow shadow(TestCanvas::device(), lowSun);
    shadow.set({});
    EXPECT_EQ(depthBy(shadow, {1, 2, 3}), 0);
}

}  // namespace
}  // namespace dustbench::draw
