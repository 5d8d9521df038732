#include "bench/world/car_model.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dustbench::world {
namespace {

void expectSound(const scene::Mesh& mesh) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.colours.size(), mesh.positions.size());
    ASSERT_LT(*std::ranges::max_element(mesh.indices), mesh.positions.size());
    std::size_t against = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                        c = mesh.positions[mesh.indices[i + 2]];
        const glm::vec3 sum =
            mesh.normals[mesh.indices[i]] + mesh.normals[mesh.indices[i + 1]] + mesh.normals[mesh.indices[i + 2]];
        if (glm::dot(glm::cross(b - a, c - a), sum) <= 0) ++against;
    }
    EXPECT_EQ(against, 0u) << "triangles that wind against their normals";
    for (const glm::vec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-4);
    for (const glm::vec3& colour : mesh.colours)
        EXPECT_TRUE(colour.r >= 0 && colour.r <= 1 && colour.g >= 0 && colour.g <= 1 && colour.b >= 0 && colour.b <= 1);
}

struct Extent {
    glm::vec3 low{1e9f}, high{-1e9f};
    explicit Extent(const scene::Mesh& mesh) {
        for (const glm::vec3& position : mesh.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
    }
};

TEST(CarModel, TrianglesWindAsTheirNormalsPoint) {
    expectSound(carBody({}, {}));
    expectSound(carWheel({}));
}

TEST(CarModel, HasTheProportionsOfACar) {
    const Extent body(carBody({}, {}));
    EXPECT_NEAR(body.high.x - body.low.x, 4.3, 0.15);
    EXPECT_NEAR(body.high.z - body.low.z, 1.9, 0.1);  // with mirrors
    EXPECT_NEAR(body.high.y, 1.48, 0.06);
    EXPECT_GT(body.low.y, 0.08);
    EXPECT_NEAR(body.high.z, -body.low.z, 1e-5);
}

TEST(CarModel, StaysBelowSixThousandTriangles) {
    EXPECT_LT((carBody({}, {}).indices.size() + carWheel({}).indices.size()) / 3, 6000u);
}

TEST(CarModel, FitsOtherMeasures) {
    scene::VehicleParameters van;
    van.wheelbaseMetres = 3.4;
    van.trackMetres = 1.8;
    van.wheelRadiusMetres = 0.4;
    van.wheelWidthMetres = 0.3;
    expectSound(carBody(van, {}));
    const Extent body(carBody(van, {})), wheel(carWheel(van));
    EXPECT_NEAR(body.high.x - body.low.x, 4.3 + 0.8, 0.15);
    EXPECT_NEAR(wheel.high.y, 0.4, 1e-3);
    EXPECT_NEAR(wheel.high.z - wheel.low.z, 0.3, 1e-3);
}

TEST(CarModel, WheelShowsItsRimOutside) {
    const scene::VehicleParameters p;
    // The brightest vertex is part of the rim, on the +Z side.
    const scene::Mesh wheel = carWheel(p);
    const auto brightest =
        std::ranges::max_element(wheel.colours, {}, [](const glm::vec3& c) { return c.r + c.g + c.b; });
    EXPECT_GT(wheel.positions[static_cast<std::size_t>(brightest - wheel.colours.begin())].z, 0);
}

}  // namespace
}  // namespace dustbench::world
