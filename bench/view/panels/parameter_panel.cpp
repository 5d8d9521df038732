#include "bench/view/panels/parameter_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <cmath>

#include "bench/view/panels/panel_canvas.h"
#include "methods/kit/files/csv.h"

namespace dustbench::view {
namespace {

/// Sliders are logarithmic if the range spans this many powers of ten.
constexpr double wideRange = 1000;

bool isSlid(const Parameter& parameter) {
    return parameter.type == ParameterType::integer || parameter.type == ParameterType::real;
}

std::string helpOf(const Parameter& parameter) {
    std::string text = parameter.help;
    if (!parameter.unit.empty()) text += fmt::format("\nunit: {}", parameter.unit);
    return text + fmt::format("\nallowed: {}\ndefault: {}", parameter.allowed(),
                              parameter.initial.empty() ? "none" : parameter.initial);
}

void showHelp(const Parameter& parameter) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28);
    ImGui::TextUnformatted(helpOf(parameter).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// Six digits are finer than any slider.
std::string textOf(const Parameter& parameter, double value) {
    if (parameter.type == ParameterType::integer) return fmt::format("{:.0f}", std::round(value));
    return files::csvNumber(std::stod(fmt::format("{:.6g}", value)));
}

}  // namespace

std::optional<ParameterEdit> ParameterPanel::show(const ParameterValues& values,
                                                  const std::map<std::string, std::string, std::less<>>& given,
                                                  WidgetMap& widgets) {
    std::optional<ParameterEdit> result;
    ImGui::PushID(id_.c_str());
    for (const Parameter& parameter : values.declared().all()) {
        ImGui::PushID(parameter.name.c_str());
        const bool isSet = given.contains(parameter.name);
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
        if (auto text = edit(parameter, values.canonical().at(parameter.name)))
            result = ParameterEdit{parameter.name, std::move(*text)};
        widgets.note(id_ + "/" + parameter.name);
        showHelp(parameter);
        ImGui::SameLine();
        isSet ? ImGui::TextUnformatted(parameter.name.c_str()) : ImGui::TextDisabled("%s", parameter.name.c_str());
        showHelp(parameter);
        if (isSet) {
            ImGui::SameLine();
            if (ImGui::SmallButton("Reset")) result = ParameterEdit{parameter.name, std::nullopt};
            widgets.note(id_ + "/" + parameter.name + "/reset");
        }
        ImGui::PopID();
    }
    ImGui::PopID();
    return result;
}

std::optional<std::string> ParameterPanel::edit(const Parameter& parameter, const std::string& value) {
    if (isSlid(parameter)) return slide(parameter, value);
    if (parameter.type == ParameterType::choice) return choose(parameter, value);
    if (parameter.type != ParameterType::boolean) return type(parameter, value);
    bool on = value == "on";
    if (!ImGui::Checkbox("##value", &on)) return std::nullopt;
    return on ? "on" : "off";
}

std::optional<std::string> ParameterPanel::slide(const Parameter& parameter, const std::string& value) {
    const bool isEdited = edited_ == parameter.name;
    double now = isEdited ? slid_ : std::stod(value);
    const bool isWide = parameter.maximum - parameter.minimum > wideRange;
    const char* const format = parameter.type == ParameterType::integer ? "%.0f" : "%.4g";
    if (ImGui::SliderScalar("##value", ImGuiDataType_Double, &now, &parameter.minimum, &parameter.maximum, format,
                            sliderFlags(isWide))) {
        edited_ = parameter.name;
        slid_ = now;
    }
    if (edited_ != parameter.name || !ImGui::IsItemDeactivatedAfterEdit()) return std::nullopt;
    edited_.clear();
    return textOf(parameter, slid_);
}

std::optional<std::string> ParameterPanel::choose(const Parameter& parameter, const std::string& value) {
    std::optional<std::string> chosen;
    if (!ImGui::BeginCombo("##value", value.c_str())) return chosen;
    for (const std::string& choice : parameter.choices)
        if (ImGui::Selectable(choice.c_str(), choice == value)) chosen = choice;
    ImGui::EndCombo();
    return chosen;
}

std::optional<std::string> ParameterPanel::type(const Parameter& parameter, const std::string& value) {
    const bool isEdited = edited_ == parameter.name;
    std::string text = isEdited ? typed_ : value;
    const bool entered = ImGui::InputText("##value", &text, ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemActive() || entered) {
        edited_ = parameter.name;
        typed_ = text;
    } else if (isEdited) {
        edited_.clear();
    }
    if (!entered) return std::nullopt;
    edited_.clear();
    return text;
}

}  // namespace dustbench::view
