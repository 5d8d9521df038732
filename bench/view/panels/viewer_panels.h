// The whole contents of the window: the picture and the panels over it.
//
// Owns: the canvas. Threads: the device's.
#pragma once

#include "bench/view/panels/panel_canvas.h"
#include "bench/view/panels/parameter_panel.h"
#include "bench/view/panels/picture_panel.h"
#include "bench/view/split_view.h"
#include "bench/view/view_state.h"
#include "bench/view/viewer.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::view {

class ViewerPanels {
 public:
    /// `fontPixels`: height of the text at scale 1.
    ViewerPanels(gpu::Device& device, float fontPixels) : canvas_(device, fontPixels), fontPixels_(fontPixels) {}

    /// Fills the target, which is `width` × `height`, with the viewer's picture and the panels. Passes input of the
    /// panels and of the mouse over the picture to the viewer. Keys reach the panels only while text is typed or
    /// `walksPanel` is set.
    void draw(Viewer& viewer, const gpu::Framebuffer& target, int width, int height, const PanelInput& input);

    /// The panels use all keys except Tab, so the viewer should not get them.
    [[nodiscard]] bool takesKeyboard() const { return canvas_.takesKeyboard() || walks_; }
    /// Scales the text and the widgets, from the next frame on.
    [[nodiscard]] double textScale() const { return wantedScale_; }
    void setTextScale(double scale) { wantedScale_ = scale; }
    [[nodiscard]] PanelCanvas& canvas() { return canvas_; }
    /// Widgets are named by their labels, parameters `a/NAME`, `b/NAME` and `world/NAME`, and the items of an open list
    /// `LABEL/ITEM`.
    [[nodiscard]] const WidgetMap& widgets() const { return widgets_; }

 private:
    void showPanel(Viewer& viewer, int height);
    void showHalf(Viewer& viewer, Half half);
    void showTime(Viewer& viewer);
    void showPace(Viewer& viewer);
    void showParameters(Viewer& viewer);
    void showFiles(Viewer& viewer);
    static void showMessage(const Viewer& viewer, int width, int height);
    void showHelp();
    void showTextSize();
    void scaleText();

    PanelCanvas canvas_;
    float fontPixels_;
    double wantedScale_ = 1, scale_ = 1;
    WidgetMap widgets_;
    ParameterPanel ofA_{"a"}, ofB_{"b"}, ofWorld_{"world"};
    PicturePanel picture_;
    bool walks_ = false;
};

/// Draws one frame of the whole window without a window, `width` × `height`, at the state's frame. Linear light. Throws
/// InputError for a state that cannot be shown, or without OpenGL.
[[nodiscard]] pictures::Image panelPicture(const ViewState& state, const SplitSettings& split, int width, int height);

}  // namespace dustbench::view
