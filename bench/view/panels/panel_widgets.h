// Small pieces of which the panels are made.
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
/// Grey, broken into lines.
void showRemark(const std::string& text);

/// ImGui::BeginTable with a first column for names, which is as wide as two others.
[[nodiscard]] bool beginTable(const char* id, int columns);

/// A list of words, noted by its label; the one that was chosen, if it is another.
[[nodiscard]] std::optional<std::string> showList(const char* label, const std::string& now,
                                                  const std::vector<std::string>& words, WidgetMap& widgets);
/// ImGuiSliderFlags of every slider. It is no field to type into: the one that ImGui 1.86 makes of a slider by Ctrl and
/// a click ends the program in rare sequences of input (an assertion of its own).
[[nodiscard]] int sliderFlags(bool logarithmic);
/// A slider of a number, noted by its label. Logarithmic if asked for.
bool showSlider(const char* label, float& value, float minimum, float maximum, const char* format, WidgetMap& widgets,
                bool logarithmic = false);
bool showSwitch(const char* label, bool& on, WidgetMap& widgets);

}  // namespace dustbench::bench
