// Small widgets that the panels share.
//
// Threads: the canvas's, within PanelCanvas::draw.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/view/panels/panel_canvas.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
