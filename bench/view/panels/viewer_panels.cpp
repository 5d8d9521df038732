#include "bench/view/panels/viewer_panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "bench/measure/statistics.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::bench {
namespace {

constexpr const char* none = "(none)";
/// Frames of which the times are shown.
constexpr std::size_t shownFrames = 120;

/// Width of the panel for the text's size.
float panelWidth() {
    return ImGui::GetFontSize() * 24;
}

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

/// A list of words; the one that was chosen, if it is another.
std::optional<std::string> list(const char* label, const std::string& now, const std::vector<std::string>& words) {
    std::optional<std::string> chosen;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 12);
    if (!ImGui::BeginCombo(label, now.c_str())) return chosen;
    for (const std::string& word : words)
        if (ImGui::Selectable(word.c_str(), word == now) && word != now) chosen = word;
    ImGui::EndCombo();
    return chosen;
}

std::vector<std::string> methodIds() {
    std::vector<std::string> ids;
    for (const MethodInfo& method : methods()) ids.push_back(method.id);
    return ids;
}

std::vector<std::string> with(std::string first, std::vector<std::string> others) {
    others.insert(others.begin(), std::move(first));
    return others;
}

ParameterValues valuesOf(const ParameterSet& declared, const ParameterTexts& given) {
    ParameterValues values(declared);
    for (const auto& [name, value] : given) values.set(name, value);
    return values;
}

void edit(ParameterTexts& given, const ParameterEdit& change) {
    if (change.text)
        given[change.name] = *change.text;
    else
        given.erase(change.name);
}

std::string inMegabytes(std::int64_t bytes) {
    return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

}  // namespace

void ViewerPanels::draw(Viewer& viewer, const gpu::Framebuffer& target, int width, int height,
                        const PanelInput& input) {
    widgets_.clear();
    target.clearColour(0.08f, 0.08f, 0.09f, 1);
    if (const std::string copied = viewer.takeCopied(); !copied.empty()) canvas_.setClipboard(copied);
    walks_ = viewer.walksPanel;
    PanelInput ofPanels = input;
    if (!takesKeyboard()) ofPanels.keys = {};
    ofPanels.keys[static_cast<std::size_t>(Key::tab)] = false;
    canvas_.draw(target, width, height, ofPanels, [&] {
        showPicture(viewer, width, height);
        if (viewer.showsPanels) showPanel(viewer, height);
        if (viewer.showsHelp) showHelp();
        showMessage(viewer, width, height);
    });
    if (!canvas_.takesMouse()) useMouse(viewer, input);
    before_ = input;
}

void ViewerPanels::showPicture(const Viewer& viewer, int width, int height) {
    const gpu::Texture& image = viewer.image();
    const float left = viewer.showsPanels ? panelWidth() : 0;
    const glm::vec2 room(std::max(static_cast<float>(width) - left, 1.0f), static_cast<float>(height));
    const glm::vec2 pixels(image.width(), image.height());
    float scale = std::min(room.x / pixels.x, room.y / pixels.y);
    if (scale > 1) scale = std::floor(scale);  // whole steps keep pixels alike
    const glm::vec2 corner = glm::floor(glm::vec2(left, 0) + 0.5f * (room - scale * pixels));
    picture_ = {corner, corner + scale * pixels};
    // Rows of a texture begin at the bottom.
    ImGui::GetBackgroundDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image.name().get())),
        ImVec2(picture_.minimum.x, picture_.minimum.y), ImVec2(picture_.maximum.x, picture_.maximum.y), ImVec2(0, 1),
        ImVec2(1, 0));
}

void ViewerPanels::useMouse(Viewer& viewer, const PanelInput& input) {
    const glm::vec2 extent = picture_.maximum - picture_.minimum;
    const glm::vec2 place = (input.mouse - picture_.minimum) / extent;
    const bool isInside =
        glm::all(glm::greaterThanEqual(place, glm::vec2(0))) && glm::all(glm::lessThan(place, glm::vec2(1)));
    if (!isInside || !before_ || before_->mouse.x < 0) return;
    const glm::vec2 moved = (input.mouse - before_->mouse) / extent.y;
    if (input.buttons[0] && viewer.split.shown == Shown::wipe) viewer.split.divider = place.x;
    if (moved != glm::vec2(0)) {
        if (input.buttons[1]) viewer.turnCamera(moved.x, moved.y);
        if (input.buttons[2]) viewer.shiftCamera(moved.x, -moved.y);
    }
    if (input.wheel != 0) viewer.dollyCamera(std::pow(0.9, static_cast<double>(input.wheel)));
}

void ViewerPanels::showPanel(Viewer& viewer, int height) {
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSize(ImVec2(panelWidth(), static_cast<float>(height)));
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    showHalf(viewer, Half::a);
    showHalf(viewer, Half::b);
    showPictures(viewer);
    ImGui::Separator();
    showTime(viewer);
    ImGui::Separator();
    showCosts(viewer);
    ImGui::Separator();
    showFiles(viewer);
    showParameters(viewer);
    ImGui::End();
}

void ViewerPanels::showHalf(Viewer& viewer, Half half) {
    const bool isA = half == Half::a;
    const bool has = viewer.session().has(half);
    ViewState state = viewer.state();
    const std::string now = has ? bench::half(state, half).method : none;
    const auto chosen = list(isA ? "A" : "B", now, isA ? methodIds() : with(none, methodIds()));
    widgets_.note(isA ? "A" : "B");
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

void ViewerPanels::showPictures(Viewer& viewer) {
    if (!viewer.session().has(Half::b)) return;
    for (const auto& [word, shown] : shownChoices.all()) {
        if (shown != Shown::a) ImGui::SameLine();
        const std::string label =
            shown == Shown::a || shown == Shown::b ? "only " + std::string(word) : std::string(word);
        if (ImGui::RadioButton(label.c_str(), viewer.split.shown == shown)) viewer.split.shown = shown;
        widgets_.note(label);
    }
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 12);
    if (viewer.split.shown == Shown::difference)
        ImGui::SliderFloat("gain", &viewer.split.gain, 1, 64, "%.1f", ImGuiSliderFlags_Logarithmic);
    else
        ImGui::SliderFloat("divider", &viewer.split.divider, 0, 1, "%.2f");
    widgets_.note(viewer.split.shown == Shown::difference ? "gain" : "divider");
}

void ViewerPanels::showTime(Viewer& viewer) {
    const ViewSession& session = viewer.session();
    const auto button = [&](const char* label, Action action) {
        if (ImGui::Button(label)) viewer.act(action);
        widgets_.note(label);
    };
    button(viewer.paused ? "Go on" : "Pause", Action::pause);
    ImGui::SameLine();
    button("Step", Action::step);
    ImGui::SameLine();
    button("Restart", Action::restart);
    ImGui::SameLine();
    button("Help", Action::help);
    const double seconds = session.world().state().timeSeconds;
    text(session.stepsToGo() > 0 ? fmt::format("preroll: {} steps to go", session.stepsToGo())
                                 : fmt::format("frame {}, {:.2f} s, {:.1f} m/s, {} particles", session.frame(), seconds,
                                               session.world().state().vehicle.speed, session.world().dust().size()));
    ViewState state = viewer.state();
    const auto change = [&](const char* label, std::string& place, const std::string& initial,
                            const std::vector<std::string>& words) {
        if (const auto chosen = list(label, place.empty() ? initial : place, words)) {
            place = *chosen == initial ? "" : *chosen;
            viewer.apply(state);
        }
        widgets_.note(label);
    };
    static const std::vector<std::string> scenes = files::listData("scenes", ".toml");
    static const std::vector<std::string> drives =
        with("(the scene's)", with(keyboardDrive, files::listData("drives", ".csv")));
    change("scene", state.scene, "", scenes);
    change("drive", state.drive, "(the scene's)", drives);
    std::string camera =
        state.cameraPath.empty() ? valuesOf(worldParameters(), state.world).choice("camera") : "by hand";
    if (const auto chosen = list("camera", camera, cameraKinds.words())) {
        state.world["camera"] = *chosen;
        state.cameraPath.clear();
        viewer.apply(state);
    }
    widgets_.note("camera");
}

void ViewerPanels::showCosts(const Viewer& viewer) {
    const ViewSession& session = viewer.session();
    for (const Half half : {Half::a, Half::b}) {
        const std::size_t index = half == Half::a ? 0 : 1;
        if (!session.has(half)) {
            history_[index].clear();
            continue;
        }
        const MethodHost& host = session.host(half);
        showHistory(index, session.cost(half));
        text(fmt::format("     CPU {}, GPU {}, {} primitives", inMegabytes(host.cpuBytes()),
                         inMegabytes(host.gpuBytes()), host.method().primitives()));
        if (!session.isSinceStart(half)) ImGui::TextDisabled("     joined later; Restart shows what a run does");
    }
    ImGui::TextDisabled("of this window, not a measurement");
}

void ViewerPanels::showHistory(std::size_t half, HalfCost cost) {
    std::vector<double>& history = history_[half];
    if (history.size() == shownFrames) history.erase(history.begin());
    history.push_back(cost.updateMs + cost.drawMs);
    text(fmt::format("{}: median {:.1f} ms, 95 % within {:.1f} ms", half == 0 ? "A" : "B", median(history),
                     quantile(history, 0.95)));
    const std::vector<float> values(history.begin(), history.end());
    ImGui::PlotLines(half == 0 ? "##history of A" : "##history of B", values.data(), static_cast<int>(values.size()), 0,
                     nullptr, 0, FLT_MAX, ImVec2(ImGui::GetContentRegionAvail().x, 1.8f * ImGui::GetFontSize()));
    text(fmt::format("     now: update {:.1f} ms, draw {:.1f} ms", cost.updateMs, cost.drawMs));
}

void ViewerPanels::showParameters(Viewer& viewer) {
    ViewState state = viewer.state();
    const auto section = [&](const char* title, ParameterPanel& panel, const ParameterSet& declared,
                             ParameterTexts& given) {
        const bool open = ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
        widgets_.note(title);
        if (!open) return;
        if (const auto change = panel.show(valuesOf(declared, given), given, widgets_)) {
            edit(given, *change);
            viewer.apply(state);
        }
    };
    section("Parameters of A", ofA_, findMethod(state.a.method).parameters, state.a.parameters);
    if (state.b) section("Parameters of B", ofB_, findMethod(state.b->method).parameters, state.b->parameters);
    section("World (a change restarts it)", ofWorld_, worldParameters(), state.world);
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
    if (ImGui::BeginTable("keys", 2)) {
        for (const KeyBinding& binding : keyBindings()) {
            if (binding.name.empty()) continue;
            ImGui::TableNextColumn();
            text(std::string(binding.name));
            ImGui::TableNextColumn();
            text(std::string(binding.help));
        }
        ImGui::EndTable();
    }
    ImGui::Separator();
    text("mouse: left moves the divider, right turns the camera, middle shifts it, the wheel comes closer");
    ImGui::End();
}

}  // namespace dustbench::bench
