#include "methods/kit/draw/depth_mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "methods/kit/draw/test_canvas.h"

namespace dustbench::draw {
namespace {

/// The range itself, of puffs as spheres in front of the eye.
constexpr gpu::ShaderFile ends{"ends.glsl", R"(
vec2 extentOf(float axisMetres, float metres, float deviationMetres, float nearMetres) {
    return axisMetres < nearMetres ? vec2(0, -1) : vec2(metres - deviationMetres, metres + deviationMetres);
}
vec2 mappingOf(float nearestMetres, float farthestMetres, float nearMetres) {
    return farthestMetres < nearestMetres ? vec2(nearMetres) : vec2(nearestMetres, farthestMetres);
}
)"};

class DustOnGpu {
 public:
    DustOnGpu(gpu::Device& device, const std::vector<glm::vec4>& spheres) {
        std::vector<float> places, looks;
        for (const glm::vec4& sphere : spheres) {
            places.insert(places.end(), {sphere.x, sphere.y, sphere.z});
            looks.insert(looks.end(), {sphere.w, 0.5f});
        }
        const auto count = static_cast<std::uint32_t>(spheres.size());
        places.resize(places.size() + 3);  // no buffer is empty
        looks.resize(looks.size() + 2);
        positions_ = gpu::Buffer(device, "positions", std::span<const float>(places));
        looks_ = gpu::Buffer(device, "looks", std::span<const float>(looks));
        const std::array<std::uint32_t, 4> tally{count, (count + 255) / 256, 1, 1};
        tally_ = gpu::Buffer(device, "tally", std::span<const std::uint32_t>(tally));
        puffs.position = &positions_;
        puffs.look = &looks_;
        puffs.tally = &tally_;
        puffs.bound = count;
    }

    GpuPuffs puffs;

 private:
    gpu::Buffer positions_, looks_, tally_;
};

TEST(DepthMapping, HasTheRangeOfTheLastPuffsAlone) {
    TestCanvas canvas(64, 48, {3, -2, 40}, {0.6, 0.1, -0.7});
    const glm::dvec3 eye = canvas.view.camera.eye, ahead = glm::normalize(canvas.view.camera.target - eye);
    DepthMapping mapping(TestCanvas::device(), ends, {});
    std::mt19937 random(1);
    const std::vector<std::pair<int, float>> clouds{{10'000, 50}, {1, 5}, {0, 1}, {257, 0.5f}, {5'000, 200}};
    for (const auto& [count, spread] : clouds) {
        std::normal_distribution<float> place(0, spread);
        std::uniform_real_distribution<float> radius(0.01f, 3);
        std::vector<glm::vec4> spheres;
        spheres.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            spheres.emplace_back(place(random), place(random), place(random), radius(random));
        double nearest = 1e30, farthest = -1;
        for (const glm::vec4& sphere : spheres) {
            const glm::dvec3 centre = glm::dvec3(sphere) - eye;
            const double distance = glm::length(centre), deviation = 0.5 * static_cast<double>(sphere.w);
            if (glm::dot(centre, ahead) < canvas.view.camera.nearMetres) continue;
            nearest = std::min(nearest, std::max(distance - deviation, 0.0));
            farthest = std::max(farthest, distance + deviation);
        }
        if (farthest < 0) nearest = farthest = canvas.view.camera.nearMetres;

        const DustOnGpu dust(TestCanvas::device(), spheres);
        mapping.useRangeOf(dust.puffs, canvas.view);
        glm::vec2 found(0);
        mapping.numbers().read(std::span(&found, 1));
        EXPECT_NEAR(found.x, nearest, 1e-5 * (1 + farthest)) << count << " puffs";
        EXPECT_NEAR(found.y, farthest, 1e-5 * (1 + farthest)) << count << " puffs";
    }
}

}  // namespace
}  // namespace dustbench::draw
