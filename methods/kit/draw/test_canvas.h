// A small image for tests and benchmarks of drawing code: a view, arbitrary opaque depths, and a layer.
//
// Owns: one OpenGL context for the whole program, and the layer. Depths: reversed, as in contract/view.h.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/view.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::draw {

class TestCanvas {
 public:
    TestCanvas(int width, int height, const glm::dvec3& eye, const glm::dvec3& along) {
        view.width = width;
        view.height = height;
        lookFrom(eye, along);
        depth_ = gpu::Texture::make2D(device(), "scene depth", gpu::Format::depth32F, width, height);
        setWall(std::nullopt);
        layer_.emplace(device(), depth_);
    }

    static gpu::Device& device() {
        static gpu::Device one;
        return one;
    }

    void lookFrom(const glm::dvec3& eye, const glm::dvec3& along) {
        view.camera.eye = eye;
        view.camera.target = eye + along;
    }
    [[nodiscard]] glm::vec3 at(const glm::vec3& fromEye) const { return glm::vec3(view.camera.eye) + fromEye; }

    /// Sets an opaque wall from a column to the right edge, at a distance along the axis; or removes it.
    void setWall(std::optional<double> distance, int fromColumn = 0) {
        wall_ = distance;
        wallFrom_ = fromColumn;
        std::vector<float> depths(static_cast<std::size_t>(view.width * view.height), 0.0f);
        for (std::size_t i = 0; i < depths.size(); ++i)
            if (isWalled(static_cast<int>(i) % view.width))
                depths[i] = static_cast<float>(view.camera.nearMetres / *distance);
        depth_.write(std::span<const float>(depths));
    }
    [[nodiscard]] bool isWalled(int x) const { return wall_ && x >= wallFrom_; }
    /// Distance of the wall in a column; infinite if there is none.
    [[nodiscard]] double wallAt(int x) const { return isWalled(x) ? *wall_ : std::numeric_limits<double>::infinity(); }
    /// Sets opaque flat ground at `below` metres under the eye, as exact as float depths allow.
    void setGround(double below) {
        wall_.reset();
        const glm::dvec3 forward = glm::normalize(view.camera.target - view.camera.eye);
        std::vector<float> depths;
        for (int y = view.height - 1; y >= 0; --y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
                const double along = below / -ray.y * glm::dot(ray, forward);
                depths.push_back(ray.y < 0 ? static_cast<float>(view.camera.nearMetres / along) : 0.0f);
            }
        depth_.write(std::span<const float>(depths));
    }

    /// Clears the layer, calls `draw(layer)` and returns the layer's picture.
    template <typename Draw>
    pictures::Image picture(const Draw& draw) {
        layer_->clear();
        draw(*layer_);
        return readBack(layer_->colour());
    }
    [[nodiscard]] gpu::Layer& layer() { return *layer_; }

    scene::View view;

 private:
    std::optional<double> wall_;
    int wallFrom_ = 0;
    gpu::Texture depth_;
    std::optional<gpu::Layer> layer_;
};

}  // namespace dustbench::draw
