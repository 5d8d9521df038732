#include "bench/view/panels/panel_widgets.h"

#include <imgui.h>

namespace dustbench::bench {
namespace {

float fieldWidth() {
    return ImGui::GetFontSize() * 12;
}

}  // namespace

float panelWidth() {
    return ImGui::GetFontSize() * 24;
}

void showText(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

void showRemark(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

bool beginTable(const char* id, int columns) {
    if (!ImGui::BeginTable(id, columns, ImGuiTableFlags_SizingStretchProp)) return false;
    for (int column = 0; column < columns; ++column)
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_None, column == 0 ? 2.0f : 1.0f);
    return true;
}

std::optional<std::string> showList(const char* label, const std::string& now, const std::vector<std::string>& words,
                                    WidgetMap& widgets) {
    std::optional<std::string> chosen;
    ImGui::SetNextItemWidth(fieldWidth());
    const bool isOpen = ImGui::BeginCombo(label, now.c_str());
    if (isOpen) {
        for (const std::string& word : words) {
            if (ImGui::Selectable(word.c_str(), word == now) && word != now) chosen = word;
            widgets.note(std::string(label) + "/" + word);
        }
        ImGui::EndCombo();
    }
    widgets.note(label);
    return chosen;
}

int sliderFlags(bool logarithmic) {
    return ImGuiSliderFlags_NoInput | (logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

bool showSlider(const char* label, float& value, float minimum, float maximum, const char* format, WidgetMap& widgets,
                bool logarithmic) {
    ImGui::SetNextItemWidth(fieldWidth());
    const bool changed = ImGui::SliderFloat(label, &value, minimum, maximum, format, sliderFlags(logarithmic));
    widgets.note(label);
    return changed;
}

bool showSwitch(const char* label, bool& on, WidgetMap& widgets) {
    const bool changed = ImGui::Checkbox(label, &on);
    widgets.note(label);
    return changed;
}

}  // namespace dustbench::bench
