#include "bench/view/panels/panel_canvas.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cfloat>
#include <filesystem>

#include "methods/contract/errors.h"

namespace dustbench::view {
namespace {

constexpr const char* fontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

struct FieldKey {
    ImGuiKey imgui;
    Key key;
};
/// The keys with which ImGui edits text and navigates between widgets.
constexpr std::array fieldKeys{FieldKey{ImGuiKey_Tab, Key::tab},
                               FieldKey{ImGuiKey_LeftArrow, Key::left},
                               FieldKey{ImGuiKey_RightArrow, Key::right},
                               FieldKey{ImGuiKey_UpArrow, Key::up},
                               FieldKey{ImGuiKey_DownArrow, Key::down},
                               FieldKey{ImGuiKey_Home, Key::home},
                               FieldKey{ImGuiKey_End, Key::end},
                               FieldKey{ImGuiKey_Delete, Key::erase},
                               FieldKey{ImGuiKey_Backspace, Key::backspace},
                               FieldKey{ImGuiKey_Enter, Key::enter},
                               FieldKey{ImGuiKey_Escape, Key::escape},
                               FieldKey{ImGuiKey_Space, Key::space},
                               FieldKey{ImGuiKey_A, Key::a},
                               FieldKey{ImGuiKey_C, Key::c},
                               FieldKey{ImGuiKey_V, Key::v},
                               FieldKey{ImGuiKey_X, Key::x},
                               FieldKey{ImGuiKey_Y, Key::y},
                               FieldKey{ImGuiKey_Z, Key::z}};

void loadFont(float pixels) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    if (std::filesystem::exists(fontFile) && fonts.AddFontFromFileTTF(fontFile, pixels)) return;
    ImFontConfig plain;
    plain.SizePixels = pixels;
    fonts.AddFontDefault(&plain);
}

void setStyle(float fontPixels) {
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(fontPixels / 13);  // ImGui's own sizes are for text of 13 pixels
    ImGui::GetStyle().WindowRounding = 0;
}

void hand(const PanelInput& input, int width, int height) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
    io.DeltaTime = static_cast<float>(input.seconds);
    const ImVec2 mouse = input.mouse.x < 0 ? ImVec2(-FLT_MAX, -FLT_MAX) : ImVec2(input.mouse.x, input.mouse.y);
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(mouse.x, mouse.y);
    for (std::size_t i = 0; i < input.buttons.size(); ++i)
        io.AddMouseButtonEvent(static_cast<int>(i), input.buttons[i]);
    io.AddMouseWheelEvent(0, input.wheel);
    for (const FieldKey& each : fieldKeys) io.AddKeyEvent(each.imgui, input.keys[static_cast<std::size_t>(each.key)]);
    io.AddKeyEvent(ImGuiMod_Ctrl, input.control);
    io.AddKeyEvent(ImGuiMod_Shift, input.shift);
#else
    io.MousePos = mouse;
    for (std::size_t i = 0; i < input.buttons.size(); ++i) io.MouseDown[i] = input.buttons[i];
    io.MouseWheel = input.wheel;
    for (std::size_t i = 0; i < keyCount; ++i) io.KeysDown[i] = input.keys[i];
    io.KeyCtrl = input.control;
    io.KeyShift = input.shift;
#endif
    io.AddInputCharactersUTF8(input.text.c_str());
}

float fieldWidth() {
    return ImGui::GetFontSize() * 12;
}

}  // namespace

PanelCanvas::PanelCanvas(gpu::Device& device, float fontPixels) : device_(device) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
#if IMGUI_VERSION_NUM >= 18700
    io.ConfigInputTrickleEventQueue = false;  // a frame processes all of its events at once
#else
    for (const FieldKey& each : fieldKeys) io.KeyMap[each.imgui] = static_cast<int>(each.key);
#endif
    io.ClipboardUserData = &clipboard_;
    io.GetClipboardTextFn = [](void* text) { return static_cast<std::string*>(text)->c_str(); };
    io.SetClipboardTextFn = [](void* text, const char* copied) { *static_cast<std::string*>(text) = copied; };
    loadFont(fontPixels);
    setStyle(fontPixels);
    if (!ImGui_ImplOpenGL3_Init("#version 450 core")) {
        ImGui::DestroyContext();
        throw InputError("panels: OpenGL cannot be loaded; on Debian, install libgl1, which contains libGL.so.1");
    }
}

PanelCanvas::~PanelCanvas() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void PanelCanvas::setFontPixels(float pixels) {
    ImGui::GetIO().Fonts->Clear();
    loadFont(pixels);
    setStyle(pixels);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

void PanelCanvas::draw(const gpu::Framebuffer& target, int width, int height, const PanelInput& input,
                       const std::function<void()>& show) {
    hand(input, width, height);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    show();
    ImGui::Render();
    target.bind();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool PanelCanvas::takesMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool PanelCanvas::takesKeyboard() const {
    return ImGui::GetIO().WantTextInput;
}

void WidgetMap::note(const std::string& name) {
    const ImVec2 minimum = ImGui::GetItemRectMin(), maximum = ImGui::GetItemRectMax();
    widgets_[name] = {{minimum.x, minimum.y}, {maximum.x, maximum.y}};
}

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

}  // namespace dustbench::view
