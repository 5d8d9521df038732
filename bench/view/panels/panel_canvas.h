// Draws panels with Dear ImGui into a framebuffer, from input given as plain values: no window is needed.
//
// Units: pixels from the upper left corner. Owns: the ImGui context and its objects on the GPU; there is one canvas at
// a time. Threads: the device's.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>

#include "bench/view/keys.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/framebuffer.h"

namespace dustbench::bench {

/// Input since the last frame: what is held now, and what was typed.
struct PanelInput {
    glm::vec2 mouse{-1};            ///< outside: negative
    std::array<bool, 3> buttons{};  ///< left, right, middle
    float wheel = 0;                ///< lines upwards
    std::array<bool, keyCount> keys{};
    bool control = false, shift = false;
    std::string text;           ///< UTF-8
    double seconds = 1.0 / 60;  ///< since the last frame, above 0
};

struct PanelRectangle {
    glm::vec2 minimum{0}, maximum{0};
    [[nodiscard]] glm::vec2 centre() const { return 0.5f * (minimum + maximum); }
};

class PanelCanvas {
 public:
    /// `fontPixels`: height of the text. Throws InputError if OpenGL's loader finds no libGL.so.1.
    PanelCanvas(gpu::Device& device, float fontPixels);
    ~PanelCanvas();
    PanelCanvas(const PanelCanvas&) = delete;
    PanelCanvas& operator=(const PanelCanvas&) = delete;

    /// One frame: `show` builds the panels, which are drawn over what the target holds.
    void draw(const gpu::Framebuffer& target, int width, int height, const PanelInput& input,
              const std::function<void()>& show);

    /// Between two frames.
    void setFontPixels(float pixels);

    /// In the last frame the panels used the mouse or the keyboard; others must ignore it.
    [[nodiscard]] bool takesMouse() const;
    [[nodiscard]] bool takesKeyboard() const;

    /// Text that a field has copied, or one for fields to paste.
    [[nodiscard]] const std::string& clipboard() const { return clipboard_; }
    void setClipboard(std::string text) { clipboard_ = std::move(text); }

 private:
    gpu::Device& device_;
    std::string clipboard_;
};

/// Where the widgets of the last frame are, by name, for scripts of input.
class WidgetMap {
 public:
    void clear() { widgets_.clear(); }
    /// The widget that was shown last.
    void note(const std::string& name);
    [[nodiscard]] const std::map<std::string, PanelRectangle>& all() const { return widgets_; }

 private:
    std::map<std::string, PanelRectangle> widgets_;
};

}  // namespace dustbench::bench
