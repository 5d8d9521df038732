// Draws panels with Dear ImGui into a framebuffer, from input given as plain values, so it needs no window; and the
// small widgets that the panels share.
//
// Units: pixels from the upper left corner. Owns: the ImGui context and its objects on the GPU; only one canvas may
// exist at a time. Threads: the device's; widgets within PanelCanvas::draw.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/view/keys.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::view {

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

/// The framebuffer for the panels, with the current size of the window.
class PanelTarget {
 public:
    explicit PanelTarget(gpu::Device& device) : device_(device) {}

    /// False for a window without an area, such as a minimised one: then there is no target.
    bool fit(int width, int height) {
        if (width < 1 || height < 1) return false;
        if (width != texture_.width() || height != texture_.height()) {
            texture_ = gpu::Texture::make2D(device_, "window", gpu::Format::rgba8, width, height);
            framebuffer_ = gpu::Framebuffer(device_, "window", &texture_, nullptr);
        }
        return true;
    }
    /// Valid after the first fit() that returned true.
    [[nodiscard]] gpu::Texture& texture() { return texture_; }
    [[nodiscard]] const gpu::Framebuffer& framebuffer() const { return framebuffer_; }

 private:
    gpu::Device& device_;
    gpu::Texture texture_;
    gpu::Framebuffer framebuffer_;
};

// --- Widgets

/// Width of the panel for the text's size, pixels.
[[nodiscard]] float panelWidth();

void showText(const std::string& line);
/// Grey text, wrapped.
void showRemark(const std::string& text);

/// ImGui::BeginTable with a first column for names, which is twice as wide as the others.
[[nodiscard]] bool beginTable(const char* id, int columns);

/// A list of words, recorded under its label. Returns the chosen word if it differs from the current one.
[[nodiscard]] std::optional<std::string> showList(const char* label, const std::string& now,
                                                  const std::vector<std::string>& words, WidgetMap& widgets);
/// ImGuiSliderFlags of every slider. They disable typing: the input field that ImGui 1.86 opens on Ctrl+click ends the
/// program in rare sequences of input with an assertion.
[[nodiscard]] int sliderFlags(bool logarithmic);
/// A slider for a number, recorded under its label. Optionally logarithmic.
bool showSlider(const char* label, float& value, float minimum, float maximum, const char* format, WidgetMap& widgets,
                bool logarithmic = false);
bool showSwitch(const char* label, bool& on, WidgetMap& widgets);

}  // namespace dustbench::view
