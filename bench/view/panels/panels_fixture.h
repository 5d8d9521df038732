// For tests: a viewer with its panels in a framebuffer, and scripted input that finds widgets by name.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "bench/view/panels/viewer_panels.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {

inline constexpr int width = 900, height = 700;

class Panels : public testing::Test {
 protected:
    Panels()
        : texture_(gpu::Texture::make2D(device_, "window", gpu::Format::rgba8, width, height)),
          target_(device_, "window", &texture_, nullptr) {}

    static bool hasMethod(std::string_view id) {
        return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
    }
    /// Opens the viewer at frame 1 of a small state.
    void open(const std::string& a, const std::string& b) {
        ViewState state;
        state.size = {96, 72};
        state.world = {{"particles", "300"}, {"preroll", "0.2"}};
        state.frame = 1;
        state.a.method = a;
        if (!b.empty()) state.b = HalfState{b, {}};
        panels_.reset();  // one canvas at a time
        viewer_ = std::make_unique<Viewer>(state, device_, folder_.path() / "saved");
        viewer_->paused = true;
        viewer_->advance(1e9);
        panels_ = std::make_unique<ViewerPanels>(device_, 13.0f);
        frames(2);
    }
    /// Draws frames of the panels; the viewer's picture does not change.
    void frames(int count) {
        for (int n = 0; n < count; ++n) {
            panels_->draw(*viewer_, target_, width, height, input_);
            input_.text.clear();
            input_.wheel = 0;
        }
    }
    [[nodiscard]] PanelRectangle at(const std::string& widget) const {
        const auto found = panels_->widgets().all().find(widget);
        if (found == panels_->widgets().all().end()) {
            ADD_FAILURE() << "no widget '" << widget << "'";
            return {};
        }
        return found->second;
    }
    void clickAt(glm::vec2 place) {
        input_.mouse = place;
        frames(2);
        input_.buttons[0] = true;
        frames(2);
        input_.buttons[0] = false;
        frames(2);
    }
    void click(const std::string& widget) { clickAt(at(widget).centre()); }
    /// Drags a slider from its middle to a share of its width: 0 left, 1 right.
    void slide(const std::string& widget, float share) {
        const PanelRectangle place = at(widget);
        input_.mouse = place.centre();
        frames(2);
        input_.buttons[0] = true;
        frames(1);
        input_.mouse.x = glm::mix(place.minimum.x, place.maximum.x, share);
        frames(2);
        input_.buttons[0] = false;
        frames(2);
    }
    [[nodiscard]] pictures::Image picture() const { return draw::readBack(texture_); }

    gpu::Device device_;
    gpu::Texture texture_;
    gpu::Framebuffer target_;
    TestFolder folder_;
    std::unique_ptr<Viewer> viewer_;
    std::unique_ptr<ViewerPanels> panels_;
    PanelInput input_;
};

/// Share of bright pixels, such as those of text, between two columns of the image.
inline double brightShare(const pictures::Image& image, int left, int right) {
    double bright = 0, all = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = left; x < right; ++x, ++all) bright += image.at(x, y).g > 0.6f;
    return bright / all;
}

}  // namespace dustbench::view
