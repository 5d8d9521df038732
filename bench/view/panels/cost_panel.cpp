#include "bench/view/panels/cost_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "bench/measure/statistics.h"
#include "bench/view/panels/panel_canvas.h"

namespace dustbench::view {
namespace {

/// By stage. Colour-blind readers can distinguish them.
constexpr std::array<ImU32, stageNames.size()> stageColours{
    IM_COL32(150, 150, 150, 255), IM_COL32(204, 121, 167, 255), IM_COL32(230, 159, 0, 255), IM_COL32(240, 228, 66, 255),
    IM_COL32(0, 158, 115, 255),   IM_COL32(86, 180, 233, 255),  IM_COL32(213, 94, 0, 255),  IM_COL32(0, 114, 178, 255)};

double stageOf(const HalfCost& cost, std::size_t stage) {
    return cost.update[stage] + cost.draw[stage];
}

template <typename Value>
std::vector<double> valuesOver(const Viewer& viewer, const Value& value) {
    std::vector<double> values;
    for (const FrameCost& frame : viewer.costs()) values.push_back(value(frame));
    return values;
}

std::vector<double> totalsOf(const Viewer& viewer, std::size_t half) {
    return valuesOver(viewer, [half](const FrameCost& frame) { return frame.halves[half].totalMs(); });
}

std::vector<double> ofWindow(const Viewer& viewer) {
    std::vector<double> values = valuesOver(viewer, [](const FrameCost& frame) { return frame.window; });
    if (values.size() > 1) values.pop_back();  // the last frame has not ended yet
    return values;
}

std::vector<std::size_t> halvesOf(const Viewer& viewer) {
    return viewer.session().hasHost(Half::b) ? std::vector<std::size_t>{0, 1} : std::vector<std::size_t>{0};
}

void showRow(std::initializer_list<std::string> cells) {
    for (const std::string& cell : cells) {
        ImGui::TableNextColumn();
        showText(cell);
    }
}

/// Table of milliseconds of halves, world and window.
void showPercentiles(const Viewer& viewer) {
    if (!beginTable("percentiles", 4)) return;
    const auto row = [](const char* name, const std::vector<double>& values) {
        const auto text = [&values](double p) { return fmt::format("{:.1f}", measure::quantile(values, p)); };
        showRow({name, text(0.5), text(0.95), text(0.99)});
    };
    showRow({"ms", "median", "p95", "p99"});
    for (const std::size_t half : halvesOf(viewer)) row(half == 0 ? "A" : "B", totalsOf(viewer, half));
    row("world", valuesOver(viewer, [](const FrameCost& frame) { return frame.world; }));
    row("window", ofWindow(viewer));
    ImGui::EndTable();
}

std::string inMegabytes(std::size_t bytes) {
    return bytes == 0 ? "" : fmt::format("{:.2f}", static_cast<double>(bytes) / 1e6);
}

/// Draws one column per frame, the latest on the right, with its stages stacked. Values above the scale are cut off.
void showStack(const Viewer& viewer, std::size_t half, double scaleMs) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 3 * ImGui::GetFontSize());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 to(from.x + size.x, from.y + size.y);
    list.AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_FrameBg));
    list.PushClipRect(from, to, true);
    const float width = size.x / static_cast<float>(Viewer::keptFrames);
    float left = to.x - width * static_cast<float>(viewer.costs().size());
    for (const FrameCost& frame : viewer.costs()) {
        float bottom = to.y;
        for (std::size_t stage = 0; stage < stageNames.size(); ++stage) {
            const auto height = static_cast<float>(stageOf(frame.halves[half], stage) / scaleMs) * size.y;
            list.AddRectFilled(ImVec2(left, bottom - height), ImVec2(left + width, bottom), stageColours[stage]);
            bottom -= height;
        }
        left += width;
    }
    list.PopClipRect();
    ImGui::Dummy(size);
}

void showSwatch(ImU32 colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float size = ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, at.y + 0.2f * size),
                                              ImVec2(at.x + 0.6f * size, at.y + 0.8f * size), colour);
    ImGui::Dummy(ImVec2(0.6f * size, size));
    ImGui::SameLine();
}

/// Table of the median of every stage that either half has. Its colours are the legend of the chart.
void showStages(const Viewer& viewer, const std::vector<std::size_t>& halves) {
    if (!beginTable("stages", 3)) return;
    for (const char* title : {"median", "A ms", "B ms"}) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", title);
    }
    for (std::size_t stage = 0; stage < stageNames.size(); ++stage) {
        std::array<std::string, 2> medians;
        for (const std::size_t half : halves) {
            const auto values = valuesOver(viewer, [&](const FrameCost& f) { return stageOf(f.halves[half], stage); });
            if (std::ranges::max(values) > 0) medians[half] = fmt::format("{:.2f}", measure::median(values));
        }
        if (medians[0].empty() && medians[1].empty()) continue;
        ImGui::TableNextColumn();
        showSwatch(stageColours[stage]);
        showText(std::string(stageNames[stage]));
        for (const std::string& text : medians) {
            ImGui::TableNextColumn();
            showText(text);
        }
    }
    ImGui::EndTable();
}

void showTimes(const Viewer& viewer, WidgetMap& widgets) {
    if (viewer.costs().empty()) return showRemark("no frame yet");
    const std::vector<std::size_t> halves = halvesOf(viewer);
    showPercentiles(viewer);
    const double scaleMs = stackScaleMs(viewer);
    for (const std::size_t half : halves) {
        showRemark(fmt::format("{}: stages stacked, scale {:.1f} ms, slowest frame {:.1f} ms{}", half == 0 ? "A" : "B",
                               scaleMs, measure::maximum(totalsOf(viewer, half)),
                               viewer.session().isSinceStart(half == 0 ? Half::a : Half::b)
                                   ? ""
                                   : "; started later, press Restart to see it as in a run"));
        showStack(viewer, half, scaleMs);
        widgets.note(half == 0 ? "Costs/stack of A" : "Costs/stack of B");
    }
    showStages(viewer, halves);
    showRemark(fmt::format("last {} frames of this window, not a measurement", viewer.costs().size()));
}

/// `Costs: A 3.1 ms, B 5.2 ms`: the title, which is visible while the section is closed.
std::string titleOf(const Viewer& viewer) {
    std::string title = "Costs";
    if (viewer.costs().empty()) return title;
    for (const std::size_t half : halvesOf(viewer))
        title += fmt::format("{} {} {:.1f} ms", half == 0 ? ":" : ",", half == 0 ? "A" : "B",
                             measure::median(totalsOf(viewer, half)));
    return title;
}

void showMemoryOf(const run::MethodHost& host, const char* half) {
    if (!beginTable((std::string("memory of ") + half).c_str(), 3)) return;
    showRow({half, "CPU MB", "GPU MB"});
    for (const MemoryUse& use : host.method().memory()) showRow({use.structure, inMegabytes(use.cpuBytes), ""});
    for (const auto& [structure, bytes] : host.gpuLedger().entries()) showRow({structure, "", inMegabytes(bytes)});
    showRow({"total", inMegabytes(static_cast<std::size_t>(host.cpuBytes())),
             inMegabytes(static_cast<std::size_t>(host.gpuBytes()))});
    ImGui::EndTable();
    showText(fmt::format("{} primitives", host.primitives()));
}

/// A section that is initially closed, recorded under `name`.
bool isOpen(const std::string& title, const std::string& name, WidgetMap& widgets) {
    const bool open = ImGui::CollapsingHeader((title + "###" + name).c_str());
    widgets.note(name);
    return open;
}

}  // namespace

double stackScaleMs(const Viewer& viewer) {
    double scaleMs = 1e-3;
    for (const std::size_t half : halvesOf(viewer))
        scaleMs = std::max(scaleMs, 1.25 * measure::quantile(totalsOf(viewer, half), 0.95));
    return scaleMs;
}

void showCosts(const Viewer& viewer, WidgetMap& widgets) {
    if (isOpen(titleOf(viewer), "Costs", widgets)) showTimes(viewer, widgets);
    if (!isOpen("Memory", "Memory", widgets)) return;
    for (const Half half : {Half::a, Half::b})
        if (viewer.session().hasHost(half)) showMemoryOf(viewer.session().host(half), half == Half::a ? "A" : "B");
}

}  // namespace dustbench::view
