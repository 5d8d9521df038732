#include "bench/view/panels/picture_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "bench/view/panels/panel_canvas.h"

namespace dustbench::view {
namespace {

std::string number(const std::optional<double>& value, int digits) {
    return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

std::string faultsText(const char* half, const LayerFaults& faults) {
    std::string text = fmt::format("{}: {} not finite, {} negative, {} with alpha outside 0..1", half, faults.notFinite,
                                   faults.negative, faults.alpha);
    if (faults.first) text += fmt::format("; the first at {}, {}", faults.first->x, faults.first->y);
    return text;
}

std::string labelOf(Shown shown) {
    if (shown == Shown::a || shown == Shown::b) return shown == Shown::a ? "A only" : "B only";
    if (shown == Shown::sideBySide) return "Side by side";
    if (shown == Shown::flip) return "FLIP";
    return shown == Shown::wipe ? "Wipe" : "Difference";
}

/// The metrics of this frame, named as in reports/METRICS.md.
void showNumbers(const measure::MetricValues& metrics) {
    if (!beginTable("numbers", 3)) return;
    const auto row = [](const std::string& name, const std::string& whole, const std::string& masked) {
        for (const std::string* cell : {&name, &whole, &masked}) {
            ImGui::TableNextColumn();
            showText(*cell);
        }
    };
    row("A vs. ground truth", "picture", "in the mask");
    const auto text = [&](const char* column, int digits) { return number(metrics.of(column), digits); };
    row("psnr_db", metrics.of("identical") == 1.0 ? "identical" : text("psnr_db", 2), text("psnr_mask_db", 2));
    row("ssim", text("ssim", 4), text("ssim_mask", 4));
    row("flip", text("flip", 4), text("flip_mask", 4));
    row("rmse_linear", text("rmse_linear", 5), text("rmse_linear_mask", 5));
    row("error_max", "", text("error_max", 4));
    ImGui::EndTable();
}

/// Text over a picture, readable on any background.
void showCaption(glm::vec2 corner, const std::string& line) {
    const ImVec2 size = ImGui::CalcTextSize(line.c_str());
    const float margin = 0.3f * ImGui::GetFontSize();
    const ImVec2 from(corner.x + margin, corner.y + margin);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(ImVec2(from.x - margin, from.y - margin),
                       ImVec2(from.x + size.x + margin, from.y + size.y + margin), IM_COL32(0, 0, 0, 150));
    list.AddText(from, IM_COL32(255, 255, 255, 255), line.c_str());
}

}  // namespace

void PicturePanel::showPicture(const Viewer& viewer, float left, int width, int height) {
    const gpu::Texture& image = viewer.image();
    const glm::vec2 room(std::max(static_cast<float>(width) - left, 1.0f), static_cast<float>(height));
    const glm::vec2 pixels(image.width(), image.height());
    float scale = std::min(room.x / pixels.x, room.y / pixels.y);
    if (scale > 1) scale = std::floor(scale);  // an integer scale keeps all pixels the same size
    const glm::vec2 corner = glm::floor(glm::vec2(left, 0) + 0.5f * (room - scale * pixels));
    picture_ = {corner, corner + scale * pixels};
    // Rows of a texture begin at the bottom.
    ImGui::GetBackgroundDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image.name().get())),
        ImVec2(picture_.minimum.x, picture_.minimum.y), ImVec2(picture_.maximum.x, picture_.maximum.y), ImVec2(0, 1),
        ImVec2(1, 0));
}

void PicturePanel::showStamp(Viewer& viewer, const PanelInput& input) const {
    showCaption(picture_.minimum, viewer.stamp());
    const auto place = placeOf(input.mouse);
    if (!place || ImGui::GetIO().WantCaptureMouse) return;
    const PixelValue value = viewer.valueAt(*place);
    const glm::ivec3 bytes = glm::ivec3(glm::round(255.0f * value.display));
    const float below = ImGui::GetFontSize() * 1.6f;
    showCaption({picture_.minimum.x, picture_.maximum.y - below},
                fmt::format("{} at {}, {}: linear {:.4f} {:.4f} {:.4f}, sRGB {} {} {}, alpha {:.4f}",
                            value.half == Half::a ? "A" : "B", value.x, value.y, value.light.r, value.light.g,
                            value.light.b, bytes.r, bytes.g, bytes.b, value.alpha));
}

std::optional<glm::vec2> PicturePanel::placeOf(glm::vec2 mouse) const {
    const glm::vec2 place = (mouse - picture_.minimum) / (picture_.maximum - picture_.minimum);
    const bool isInside =
        glm::all(glm::greaterThanEqual(place, glm::vec2(0))) && glm::all(glm::lessThan(place, glm::vec2(1)));
    return isInside ? std::optional(place) : std::nullopt;
}

void PicturePanel::useMouse(Viewer& viewer, const PanelInput& input) {
    const std::optional<PanelInput> before = std::exchange(before_, input);
    const auto place = placeOf(input.mouse);
    if (!place || !before || before->mouse.x < 0 || ImGui::GetIO().WantCaptureMouse) return;
    const glm::vec2 extent = picture_.maximum - picture_.minimum;
    const glm::vec2 pixels = input.mouse - before->mouse;
    if (input.buttons[0] && viewer.split.shown == Shown::wipe && !input.control) viewer.split.divider = place->x;
    if (pixels != glm::vec2(0)) {
        const glm::vec2 moved = pixels / extent.y;
        if (input.buttons[0] && input.control) viewer.pan(pixels / extent);
        if (input.buttons[1]) viewer.turnCamera(moved.x, moved.y);
        if (input.buttons[2]) viewer.shiftCamera(moved.x, -moved.y);
    }
    if (input.wheel == 0) return;
    const double factor = std::pow(0.9, static_cast<double>(input.wheel));
    input.control ? viewer.zoom(*place, 1 / factor) : viewer.dollyCamera(factor);
}

void PicturePanel::showChoices(Viewer& viewer, WidgetMap& widgets) {
    if (viewer.session().has(Half::b)) showHalves(viewer, widgets);
    showChannel(viewer, widgets);
    showSlider("Exposure", viewer.split.stops, -8, 8, "%+.1f stops", widgets);
    float zoom = 1 / viewer.split.extent.x;
    if (showSlider("Zoom", zoom, 1, 64, "%.1f", widgets, true))
        viewer.zoom({0.5f, 0.5f}, static_cast<double>(zoom * viewer.split.extent.x));
    if (viewer.session().isExact(Half::b)) showExact(viewer, widgets);
}

void PicturePanel::showHalves(Viewer& viewer, WidgetMap& widgets) {
    constexpr int inRow = 3;
    int shownSoFar = 0;
    for (const auto& [word, shown] : shownChoices.all()) {
        if (shownSoFar++ % inRow != 0) ImGui::SameLine();
        const std::string label = labelOf(shown);
        if (ImGui::RadioButton(label.c_str(), viewer.split.shown == shown)) viewer.split.shown = shown;
        widgets.note(label);
    }
    if (viewer.split.shown == Shown::difference) showSlider("Gain", viewer.split.gain, 1, 64, "%.1f", widgets, true);
    if (viewer.split.shown == Shown::wipe) showSlider("Divider", viewer.split.divider, 0, 1, "%.2f", widgets);
    if (const auto mean = viewer.maps().flipMean(); mean && viewer.settingsNow().shown == Shown::flip)
        showRemark(fmt::format("FLIP: mean {:.4f}; black: 0, yellow: 1; computed in {:.2f} s", *mean,
                               viewer.maps().flipSeconds()));
}

void PicturePanel::showChannel(Viewer& viewer, WidgetMap& widgets) {
    Channel& channel = viewer.split.channel;
    if (const auto word =
            showList("Channel", std::string(channelChoices.wordOf(channel)), channelChoices.words(), widgets))
        channel = channelChoices.valueOf(*word);
    if (channel == Channel::alpha) showRemark("alpha of the layer; black: 0, white: 1");
    if (channel == Channel::depth) showRemark("depth of the opaque scene; white: 1 m, black: 1 km or more");
    if (channel == Channel::overdraw)
        showRemark(fmt::format("primitives per pixel; black: 0, yellow: {:.0f}", viewer.maps().overdrawLimit()));
    if (channel == Channel::outlines) showRemark("yellow: quads, blue: voxels; brighter where several overlap");
    if (channel != Channel::faults) return;
    showRemark("magenta: not finite, cyan: negative, yellow: alpha outside 0..1");
    for (const Half half : {Half::a, Half::b})
        if (viewer.session().isCurrent(half)) showText(faultsText(half == Half::a ? "A" : "B", viewer.faults(half)));
}

void PicturePanel::showExact(Viewer& viewer, WidgetMap& widgets) {
    showSwitch("Ground truth in every frame", viewer.exactEveryFrame, widgets);
    if (!viewer.session().isEvaluated()) {
        showRemark(viewer.session().isCurrent(Half::b)
                       ? "B is drawn by exact_tiles, which is within 1e-5 of the ground truth. Pause (Space or E) to "
                         "compute the ground truth and the metrics."
                       : "The ground truth is computed only while nothing moves. Pause (Space or E) to see it; until "
                         "then, only A is shown.");
        return;
    }
    const ExactHalf& exact = viewer.session().exact();
    exact.whyNotEvaluated().empty() ? showNumbers(exact.evaluated().metrics.values)
                                    : showRemark(exact.whyNotEvaluated());
    showRemark(fmt::format("ground truth and metrics of frame {}: computed in {:.2f} s", viewer.session().drawnFrame(),
                           exact.seconds()));
}

}  // namespace dustbench::view
