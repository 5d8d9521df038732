// Draws panels with Dear ImGui into a framebuffer, from input given as plain values, so it needs no window.
//
// Units: pixels from the upper left corner. Owns: the ImGui context and its objects on the GPU; only one canvas may
// exist at a time. Threads: the device's.
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

/// Input of a frame: the keys and buttons that are held, and the text typed since the last frame.
struct PanelInput {
    glm::vec2 mouse{-1};            ///< negative if outside
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

    /// Draws one frame: `show` builds the panels, which are drawn over the contents of the target.
    void draw(const gpu::Framebuffer& target, int width, int height, const PanelInput& input,
              const std::function<void()>& show);

    /// Call between two frames.
    void setFontPixels(float pixels);

    /// The panels used the mouse or the keyboard in the last frame, so others must ignore it.
    [[nodiscard]] bool takesMouse() const;
    [[nodiscard]] bool takesKeyboard() const;

    /// Text that a field has copied, or that fields can paste.
    [[nodiscard]] const std::string& clipboard() const { return clipboard_; }
    void setClipboard(std::string text) { clipboard_ = std::move(text); }

 private:
    gpu::Device& device_;
    std::string clipboard_;
};

/// Positions of the last frame's widgets by name, for scripted input.
class WidgetMap {
 public:
    void clear() { widgets_.clear(); }
    /// Records the widget that was shown last.
    void note(const std::string& name);
    [[nodiscard]] const std::map<std::string, PanelRectangle>& all() const { return widgets_; }

 private:
    std::map<std::string, PanelRectangle> widgets_;
};

}  // namespace dustbench::bench
