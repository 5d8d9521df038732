#include "bench/view/panels/viewer_panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "bench/view/panels/cost_panel.h"
#include "bench/view/panels/panel_canvas.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::view {
namespace {

constexpr const char* none = "(none)";

std::vector<std::string> methodIds() {
    std::vector<std::string> ids;
    for (const MethodInfo& method : methods()) ids.push_back(method.id);
    return ids;
}

std::vector<std::string> with(std::string first, std::vector<std::string> others) {
    others.insert(others.begin(), std::move(first));
    return others;
}

ParameterValues valuesOf(const ParameterSet& declared, const results::ParameterTexts& given) {
    ParameterValues values(declared);
    for (const auto& [name, value] : given) values.set(name, value);
    return values;
}

void edit(results::ParameterTexts& given, const ParameterEdit& change) {
    if (change.text)
        given[change.name] = *change.text;
    else
        given.erase(change.name);
}

/// Selectable scales of the text.
constexpr std::array textScales{0.75, 1.0, 1.25, 1.5, 2.0, 3.0};

std::string percentText(double scale) {
    return fmt::format("{:.0f} %", 100 * scale);
}

std::string speedText(int slowness) {
    return slowness == 1 ? "full" : fmt::format("1/{}", slowness);
}

constexpr float fontPixels = 15;
/// ImGui knows the size of a table only after a frame.
constexpr int framesToSettle = 2;
/// The ground truth is drawn when nothing has moved for a frame.
constexpr int framesToRest = 2;

}  // namespace

void ViewerPanels::draw(Viewer& viewer, const gpu::Framebuffer& target, int width, int height,
                        const PanelInput& input) {
    scaleText();
    widgets_.clear();
    target.clearColour(0.08f, 0.08f, 0.09f, 1);
    if (const std::string copied = viewer.takeCopied(); !copied.empty()) canvas_.setClipboard(copied);
    walks_ = viewer.walksPanel;
    PanelInput ofPanels = input;
    if (!takesKeyboard()) ofPanels.keys = {};
    ofPanels.keys[static_cast<std::size_t>(Key::tab)] = false;
    canvas_.draw(target, width, height, ofPanels, [&] {
        picture_.showPicture(viewer, viewer.showsPanels ? panelWidth() : 0, width, height);
        if (viewer.showsPanels) picture_.showStamp(viewer, input);
        if (viewer.showsPanels) showPanel(viewer, height);
        if (viewer.showsHelp) showHelp();
        showMessage(viewer, width, height);
        picture_.useMouse(viewer, input);
    });
}

void ViewerPanels::scaleText() {
    if (scale_ == wantedScale_) return;
    scale_ = wantedScale_;
    canvas_.setFontPixels(fontPixels_ * static_cast<float>(scale_));
}

void ViewerPanels::showPanel(Viewer& viewer, int height) {
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSize(ImVec2(panelWidth(), static_cast<float>(height)));
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    showHalf(viewer, Half::a);
    showHalf(viewer, Half::b);
    picture_.showChoices(viewer, widgets_);
    ImGui::Separator();
    showTime(viewer);
    ImGui::Separator();
    showCosts(viewer, widgets_);
    ImGui::Separator();
    showFiles(viewer);
    showParameters(viewer);
    ImGui::End();
}

void ViewerPanels::showHalf(Viewer& viewer, Half half) {
    const bool isA = half == Half::a;
    const bool has = viewer.session().has(half);
    ViewState state = viewer.state();
    const std::string now = has ? view::half(state, half).method : none;
    const auto chosen =
        showList(isA ? "A" : "B", now, isA ? methodIds() : with(none, with(exactPicture, methodIds())), widgets_);
    if (!chosen) return;
    if (isA)
        state.a = {*chosen, {}};
    else if (*chosen == none)
        state.b.reset();
    else
        state.b = HalfState{*chosen, {}};
    viewer.apply(state);
    if (!isA && state.b && viewer.split.shown == Shown::a) viewer.split.shown = Shown::wipe;
}

void ViewerPanels::showPace(Viewer& viewer) {
    std::vector<std::string> words(slownesses.size());
    std::ranges::transform(slownesses, words.begin(), speedText);
    if (const auto chosen = showList("Speed", speedText(viewer.slowness), words, widgets_))
        viewer.slowness = slownesses.at(static_cast<std::size_t>(std::ranges::find(words, *chosen) - words.begin()));
    ImGui::SameLine();
    bool isDrawn = !viewer.drawingPaused;
    if (showSwitch("Drawing", isDrawn, widgets_)) viewer.drawingPaused = !isDrawn;
    showSwitch("Draw less to keep 15 fps", viewer.keepsPace, widgets_);
    if (const std::string remark = viewer.drawnRemark(); !remark.empty()) showRemark(remark);
}

void ViewerPanels::showTime(Viewer& viewer) {
    const ViewSession& session = viewer.session();
    const auto button = [&](const char* label, Action action) {
        if (ImGui::Button(label)) viewer.act(action);
        widgets_.note(label);
    };
    button(viewer.paused ? "Resume" : "Pause", Action::pause);
    ImGui::SameLine();
    button("Step", Action::step);
    ImGui::SameLine();
    button("Restart", Action::restart);
    ImGui::SameLine();
    button("Help", Action::help);
    showPace(viewer);
    const double seconds = session.world().state().timeSeconds;
    showText(session.stepsToGo() > 0
                 ? fmt::format("preroll: {} steps left", session.stepsToGo())
                 : fmt::format("frame {}, {:.2f} s, {:.1f} m/s, {} particles", session.frame(), seconds,
                               session.world().state().vehicle.speed, session.world().dust().size()));
    ViewState state = viewer.state();
    const auto change = [&](const char* label, std::string& place, const std::string& initial,
                            const std::vector<std::string>& words) {
        if (const auto chosen = showList(label, place.empty() ? initial : place, words, widgets_)) {
            place = *chosen == initial ? "" : *chosen;
            viewer.apply(state);
        }
    };
    static const std::vector<std::string> scenes = files::listData("scenes", ".toml");
    static const std::vector<std::string> drives =
        with("(scene default)", with(keyboardDrive, files::listData("drives", ".csv")));
    change("Scene", state.scene, "", scenes);
    change("Drive", state.drive, "(scene default)", drives);
    std::string camera =
        state.cameraPath.empty() ? valuesOf(world::worldParameters(), state.world).choice("camera") : "custom";
    if (const auto chosen = showList("Camera", camera, world::cameraKinds.words(), widgets_)) {
        state.world["camera"] = *chosen;
        state.cameraPath.clear();
        viewer.apply(state);
    }
}

void ViewerPanels::showParameters(Viewer& viewer) {
    ViewState state = viewer.state();
    const auto section = [&](const char* title, ParameterPanel& panel, const ParameterSet& declared,
                             results::ParameterTexts& given) {
        const bool open = ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
        widgets_.note(title);
        if (!open) return;
        if (const auto change = panel.show(valuesOf(declared, given), given, widgets_)) {
            edit(given, *change);
            viewer.apply(state);
        }
    };
    section("Parameters of A", ofA_, findMethod(state.a.method).parameters, state.a.parameters);
    if (viewer.session().hasHost(Half::b))
        section("Parameters of B", ofB_, findMethod(state.b->method).parameters, state.b->parameters);
    section("World (changes restart it)", ofWorld_, world::worldParameters(), state.world);
}

void ViewerPanels::showFiles(Viewer& viewer) {
    if (ImGui::Button("Copy command")) viewer.act(Action::copyLine);
    widgets_.note("Copy command");
    ImGui::SameLine();
    if (ImGui::Button("Paste")) viewer.applyText(canvas_.clipboard());
    widgets_.note("Paste");
    ImGui::SameLine();
    if (ImGui::Button("Save picture")) viewer.act(Action::savePicture);
    widgets_.note("Save picture");
    if (ImGui::Button("Save volume")) viewer.act(Action::saveVolume);
    widgets_.note("Save volume");
    ImGui::SameLine();
    if (ImGui::Button("Measure")) viewer.act(Action::measure);
    widgets_.note("Measure");
    ImGui::SameLine();
    ImGui::TextDisabled("takes a few minutes");
    for (const std::string& sentence : viewer.measured()) ImGui::TextWrapped("%s", sentence.c_str());
}

void ViewerPanels::showMessage(const Viewer& viewer, int width, int height) {
    if (viewer.message().empty()) return;
    const float left = viewer.showsPanels ? panelWidth() : 0;
    ImGui::SetNextWindowPos(ImVec2(left, static_cast<float>(height)), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSize(ImVec2(static_cast<float>(width) - left, 0));
    ImGui::Begin("message", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextWrapped("%s", viewer.message().c_str());
    ImGui::End();
}

void ViewerPanels::showHelp() {
    ImGui::SetNextWindowPos(ImVec2(panelWidth() + ImGui::GetFontSize(), ImGui::GetFontSize()), ImGuiCond_Appearing);
    ImGui::SetNextWindowBgAlpha(1);
    ImGui::Begin("Keys", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    showTextSize();  // first, because a small window cuts off the end of the list
    ImGui::Separator();
    if (ImGui::BeginTable("keys", 2)) {
        const auto row = [](std::string_view name, std::string_view help) {
            ImGui::TableNextColumn();
            showText(std::string(name));
            ImGui::TableNextColumn();
            showText(std::string(help));
        };
        for (const KeyBinding& binding : keyBindings())
            if (!binding.name.empty()) row(binding.name, binding.help);
        row("gamepad", "left stick steers, right trigger accelerates, left trigger brakes");
        for (const PadBinding& binding : padBindings()) row(binding.name, binding.help);
        ImGui::EndTable();
    }
    ImGui::Separator();
    showText(
        "Mouse: drag with the left button to move the divider, right to rotate the camera, middle to pan it;\n"
        "the wheel moves the camera closer. With Ctrl, the wheel zooms the picture and the left button pans it.");
    ImGui::End();
}

void ViewerPanels::showTextSize() {
    std::vector<std::string> words;
    std::ranges::transform(textScales, std::back_inserter(words), percentText);
    if (const auto chosen = showList("Text size", percentText(wantedScale_), words, widgets_))
        wantedScale_ = textScales.at(static_cast<std::size_t>(std::ranges::find(words, *chosen) - words.begin()));
}

pictures::Image panelPicture(const ViewState& state, const SplitSettings& split, int width, int height) {
    gpu::Device device;
    Viewer viewer(state, device, "view");
    viewer.paused = true;
    if (state.b) viewer.split = split;
    viewer.split.channel = split.channel;
    viewer.advance(std::numeric_limits<double>::infinity());
    for (int n = 0; n < framesToRest; ++n) viewer.advance();
    if (!viewer.message().empty()) throw InputError("view: " + viewer.message());
    ViewerPanels panels(device, fontPixels);
    const gpu::Texture texture = gpu::Texture::make2D(device, "window", gpu::Format::rgba8, width, height);
    const gpu::Framebuffer target(device, "window", &texture, nullptr);
    for (int n = 0; n < framesToSettle; ++n) panels.draw(viewer, target, width, height, {});
    pictures::Image picture = pictures::decoded(draw::readBack(texture));
    for (glm::vec4& pixel : picture.pixels) pixel.a = 1;
    return picture;
}

}  // namespace dustbench::view
